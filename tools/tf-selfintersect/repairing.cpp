#include "tools/tf-selfintersect/repairing.hpp"

#include "tools/common/arrangeable.hpp"
#include "tools/common/certified_output.hpp"
#include "tools/common/console.hpp"
#include "tools/tf-selfintersect/words.hpp"
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

json triple(const tf::point3& p) { return {p.x, p.y, p.z}; }

tf::resolve_result compute(job& work, const findings& result, const repair_settings& settings,
                           bool to_single) {
    check_arrangeable(work.name, result.mesh);
    const auto timing = work.time("repair");
    tf::resolve_options options;
    options.touching = settings.touching;
    options.precision = to_single ? tf::precision::float32 : tf::precision::float64;
    options.progress = work.progress("repair");
    tf::resolve_result repaired =
        tf::resolve_self_intersections(result.mesh, settings.mode, options);
    work.out.end_progress();
    work.keeper.check();
    if (repaired.certificate.status == tf::status::cancelled)
        throw failure(stopped, "stopped", work.name + ": stopped");
    return repaired;
}

json edge_entry(const tf::open_edge& edge, const findings& result) {
    return {{"face", result.stored_face(edge.face.index)},
            {"from", triple(edge.ends[0])},
            {"to", triple(edge.ends[1])}};
}

const tf::point3& meeting_place(const tf::resolve_result& repaired, std::uint32_t face) {
    return repaired.mesh.points[repaired.mesh.faces[face][0]];
}

void enter_repair(job& work, const findings& result, const repair_settings& settings,
                  const tf::resolve_result& repaired, double allowed, bool to_single) {
    json open = json::array(), meeting = json::array();
    for (const auto& edge : repaired.certificate.open) open.push_back(edge_entry(edge, result));
    for (const auto& [f, g] : repaired.certificate.meeting)
        meeting.push_back({{"faces", {f, g}}, {"near", triple(meeting_place(repaired, f))}});
    const tf::mesh& surface = repaired.mesh;
    const auto topology = tf::count_topology(surface.points.size(), surface.faces);
    work.entry["repair"] = {
        {"mode", name_of(settings.mode)},
        {"certified", static_cast<bool>(repaired.certificate)},
        {"self_intersections",
         {{"before", result.pairs_that_count()}, {"after", repaired.certificate.meeting_count}}},
        {"meeting", meeting},
        {"open", {{"count", repaired.certificate.open_count}, {"list", open}}},
        {"max_move",
         {{"given", settings.max_move.given},
          {"used", allowed},
          {"largest", repaired.certificate.max_displacement},
          {"step", tf::coordinate_step(surface.points, to_single ? tf::precision::float32
                                                                 : tf::precision::float64)}}},
        {"removed_faces", repaired.statistics.removed},
        {"covered_faces", repaired.statistics.covered},
        {"filled_faces", repaired.statistics.filled},
        {"left_open_edges", repaired.statistics.left_open},
        {"lost_components", repaired.vanished_components},
        {"volume",
         {{"before", tf::signed_volume(result.mesh)}, {"after", tf::signed_volume(surface)}}},
        {"precision_out", to_single ? "float" : "double"},
        {"vertices", surface.points.size()},
        {"faces", surface.faces.size()},
        {"components", topology.components_by_point},
        {"boundary_edges", topology.boundary_edges},
        {"nonmanifold_edges", topology.nonmanifold_edges}};
}

/// Why the result cannot be taken; empty when it can.
std::string objection(const findings& result, const repair_settings& settings,
                      const tf::resolve_result& repaired, double allowed, bool to_single) {
    if (repaired.certificate.open_count > 0)
        return "it bounds no solid: its surface ends at " +
               counted(repaired.certificate.open_count, "edge", "edges") + ", the first from " +
               in_words(repaired.certificate.open.front().ends[0]) + " to " +
               in_words(repaired.certificate.open.front().ends[1]) + " at face " +
               std::to_string(result.stored_face(repaired.certificate.open.front().face.index)) +
               "; --repair=split or --repair=remove do without";
    if (repaired.certificate.meeting_count > 0)
        return counted(repaired.certificate.meeting_count, "self-intersecting pair",
                       "self-intersecting pairs") +
               (repaired.certificate.meeting_count == 1 ? " remains" : " remain") +
               ", the first near " +
               in_words(meeting_place(repaired, repaired.certificate.meeting.front()[0])) +
               (to_single && settings.mode != tf::resolve_mode::remove
                    ? "; --precision double, in a format that has it, may do"
                    : "");
    if (!repaired.certificate && repaired.certificate.status != tf::status::vanished)
        return settings.mode == tf::resolve_mode::remove &&
                       std::isfinite(repaired.certificate.max_displacement)
                   ? "a hole could not be closed"
                   : "coordinates are too large";
    if (repaired.mesh.faces.empty() && repaired.statistics.exact_faces > 0)
        return "nothing would be left: all of the exact result, " +
               counted(repaired.statistics.exact_faces, "face", "faces") + ", is thinner than " +
               (to_single ? "float32" : "double") + " numbers tell apart there" +
               (to_single ? "; --precision double may do" : "");
    if (repaired.mesh.faces.empty() && !result.mesh.faces.empty())
        return std::string("nothing would be left") +
               (settings.mode == tf::resolve_mode::outer
                    ? ": the faces cancel each other out and bound nothing"
                    : "") +
               "; --repair=split keeps one of each";
    if (repaired.certificate.max_displacement > allowed)
        return "a point would move by " + shortest(repaired.certificate.max_displacement) +
               ", more than " + shortest(allowed) + " (--max-move)";
    if (settings.keep_components && repaired.vanished_components > 0)
        return counted(repaired.vanished_components, "component", "components") +
               " would disappear (--keep-components)";
    return {};
}

void say_result(job& work, const repair_settings& settings, const tf::resolve_result& repaired) {
    std::string text = work.name + ": repaired (" + name_of(settings.mode) +
                       "): " + counted(repaired.mesh.faces.size(), "face", "faces") +
                       ", no self-intersections";
    if (repaired.statistics.removed > 0)
        text += ", " + counted(repaired.statistics.removed, "face", "faces") + " removed";
    if (repaired.statistics.covered > 0)
        text +=
            ", " + counted(repaired.statistics.covered, "face lies", "faces lie") + " on others";
    if (repaired.statistics.filled > 0)
        text += ", " + grouped(repaired.statistics.filled) + " filled in";
    if (repaired.statistics.left_open > 0)
        text += ", " + counted(repaired.statistics.left_open, "edge", "edges") + " left open";
    if (repaired.certificate.max_displacement > 0.0)
        text += ", rounding moved points by " + shortest(repaired.certificate.max_displacement) +
                " at most";
    work.out.result(text);
    if (repaired.vanished_components > 0)
        work.warn("lost-components",
                  counted(repaired.vanished_components, "component has", "components have") +
                      " disappeared" +
                      (settings.mode == tf::resolve_mode::split && repaired.statistics.covered > 0
                           ? ", or all of it lies on others"
                           : ""));
}

/// The input with other points than it has in the file, those that were searched; what points have
/// is left out, for they may stand for several.
tf::mesh_file with_searched_points(const tf::mesh_file& input, const findings& result) {
    tf::mesh_file file{
        .mesh = result.mesh, .stored_face = input.stored_face, .attributes = input.attributes};
    std::erase_if(file.attributes.elements,
                  [](const tf::element& e) { return e.name == "vertex"; });
    return file;
}

std::vector<tf::operand_element> of_input(const std::vector<std::uint32_t>& indices) {
    std::vector<tf::operand_element> elements;
    elements.reserve(indices.size());
    for (const std::uint32_t index : indices)
        elements.push_back(index == tf::resolve_result::none ? tf::operand_element{}
                                                             : tf::operand_element{0, index});
    return elements;
}

/// The face that each one lies in, -1 where it fills a hole.
void add_source_faces(tf::mesh_file& file, const findings& result,
                      const std::vector<std::uint32_t>& face_of) {
    std::vector<std::int32_t> sources;
    sources.reserve(face_of.size());
    for (const std::uint32_t f : face_of)
        sources.push_back(
            f == tf::resolve_result::none ? -1 : static_cast<std::int32_t>(result.stored_face(f)));
    tf::element& rows = tf::obtain_element(file.attributes, "face", file.mesh.faces.size());
    tf::set_column(rows, tf::make_column<std::int32_t>("source_face", sources));
}

void write_repaired(job& work, const tf::mesh_file& input, const findings& result,
                    tf::resolve_result& repaired, const std::filesystem::path& output,
                    const written_form& form, bool to_single) {
    const auto timing = work.time("write");
    tf::mesh_file file;
    file.mesh = std::move(repaired.mesh);
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = to_single ? tf::precision::float32 : tf::precision::float64;
    const tf::carry_source whole{&input, result.triangle_of_face};
    std::optional<tf::mesh_file> searched;
    if (input.mesh.points.size() != result.mesh.points.size())
        searched = with_searched_points(input, result);
    const tf::carry_source source{searched ? &*searched : &input, result.triangle_of_face};
    tf::carry(file, {&source, 1},
              {of_input(repaired.face_source), of_input(repaired.vertex_source)});
    if ((searched && tf::has_vertex_values({&whole, 1})) || tf::has_values_left_out({&whole, 1}))
        work.warn("attributes", "not all properties of the input are carried over");
    add_source_faces(file, result, repaired.face_source);
    const tf::write_result written = write_certified(work, file, form, output);
    work.entry["output"] = {{"file", output.string()},
                            {"format", written.format},
                            {"precision_out", to_single ? "float" : "double"},
                            {"max_move", written.max_displacement}};
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
}

}  // namespace

const char* name_of(tf::resolve_mode mode) {
    switch (mode) {
        case tf::resolve_mode::split:
            return "split";
        case tf::resolve_mode::outer:
            return "outer";
        case tf::resolve_mode::remove:
            return "remove";
    }
    return "";
}

bool repair_and_write(job& work, const tf::mesh_file& file, const findings& result,
                      const repair_settings& settings,
                      const std::optional<std::filesystem::path>& output) {
    std::optional<written_form> form;
    if (output) form = form_of(work, file, *output);
    const tf::mesh_file* const input = &file;
    const bool to_single = writes_single(work.options, form, {&input, 1});
    tf::resolve_result repaired = compute(work, result, settings, to_single);
    const double allowed = settings.max_move.used(result.box ? tf::diagonal(*result.box) : 0.0);
    enter_repair(work, result, settings, repaired, allowed, to_single);
    work.entry["repair"]["separated_points"] = repaired.statistics.split_vertices;
    if (const std::string why = objection(result, settings, repaired, allowed, to_single);
        !why.empty()) {
        work.out.result(work.name + ": not repaired, nothing written: " + why);
        return false;
    }
    say_result(work, settings, repaired);
    warn_of_moves(work, repaired.mesh.points, repaired.certificate.max_displacement, to_single);
    if (output && !work.options.dry_run)
        write_repaired(work, file, result, repaired, *output, *form, to_single);
    return true;
}

}  // namespace tools
