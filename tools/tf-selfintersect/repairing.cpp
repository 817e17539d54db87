#include "tools/tf-selfintersect/repairing.hpp"

#include "tools/common/arrangeable.hpp"
#include "tools/common/carried_properties.hpp"
#include "tools/common/certified_output.hpp"
#include "tools/common/console.hpp"
#include "tools/tf-selfintersect/words.hpp"
#include <libmesh/boolean/separate_fans.hpp>
#include <libmesh/round/rounding_harm.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/topology.hpp>
#include <treeform/mesh/volume.hpp>
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

tf::repaired_mesh compute(job& work, const findings& result, const repair_settings& settings,
                          bool to_single) {
    check_arrangeable(work.name, result.mesh);
    const auto timing = work.time("repair");
    tf::repair_options options;
    options.mode = settings.mode;
    options.touching = settings.touching;
    options.to_float = to_single;
    options.progress = work.progress("repair");
    tf::repaired_mesh repaired = tf::repair(result.mesh, options);
    work.out.end_progress();
    work.keeper.check();
    if (repaired.cancelled) throw failure(stopped, "stopped", work.name + ": stopped");
    return repaired;
}

/// Gives touching parts of a solid points of their own; how many.
std::uint64_t separate_parts(tf::repaired_mesh& repaired) {
    tf::separated_fans separated = tf::separate_fans(repaired.surface);
    repaired.surface = std::move(separated.surface);
    for (std::size_t p = repaired.point_of.size(); p < separated.point_of.size(); ++p)
        repaired.point_of.push_back(repaired.point_of[separated.point_of[p]]);
    return separated.doubled_points;
}

json edge_entry(const tf::open_operand_edge& edge, const findings& result) {
    return {{"face", result.stored_face(edge.face.index)},
            {"from", triple(edge.ends[0])},
            {"to", triple(edge.ends[1])}};
}

const tf::point3& meeting_place(const tf::repaired_mesh& repaired, std::uint32_t face) {
    return repaired.surface.points[repaired.surface.faces[face][0]];
}

void enter_repair(job& work, const findings& result, const repair_settings& settings,
                  const tf::repaired_mesh& repaired, double allowed, bool to_single) {
    json open = json::array(), meeting = json::array();
    for (const auto& edge : repaired.open) open.push_back(edge_entry(edge, result));
    for (const auto& [f, g] : repaired.meeting)
        meeting.push_back({{"faces", {f, g}}, {"near", triple(meeting_place(repaired, f))}});
    const tf::mesh& surface = repaired.surface;
    const auto topology = tf::count_topology(surface.points.size(), surface.faces);
    const bool is_lost = surface.faces.empty() && !result.mesh.faces.empty();
    work.entry["repair"] = {
        {"mode", name_of(settings.mode)},
        {"certified", repaired.certified && !is_lost},
        {"self_intersections",
         {{"before", result.pairs_that_count()}, {"after", repaired.meeting_count}}},
        {"meeting", meeting},
        {"open", {{"count", repaired.open_count}, {"list", open}}},
        {"max_move",
         {{"given", settings.max_move.given},
          {"used", allowed},
          {"largest", repaired.max_move},
          {"step", tf::coordinate_step(surface.points, to_single)}}},
        {"removed_faces", repaired.removed},
        {"covered_faces", repaired.covered},
        {"filled_faces", repaired.filled},
        {"left_open_edges", repaired.left_open},
        {"lost_components", repaired.lost_components},
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
                      const tf::repaired_mesh& repaired, double allowed, bool to_single) {
    if (repaired.open_count > 0)
        return "it bounds no solid: its surface ends at " +
               counted(repaired.open_count, "edge", "edges") + ", the first from " +
               in_words(repaired.open.front().ends[0]) + " to " +
               in_words(repaired.open.front().ends[1]) + " at face " +
               std::to_string(result.stored_face(repaired.open.front().face.index)) +
               "; --repair=split or --repair=remove do without";
    if (repaired.meeting_count > 0)
        return counted(repaired.meeting_count, "self-intersecting pair",
                       "self-intersecting pairs") +
               (repaired.meeting_count == 1 ? " remains" : " remain") + ", the first near " +
               in_words(meeting_place(repaired, repaired.meeting.front()[0])) +
               (to_single && settings.mode != tf::repair_mode::remove
                    ? "; --precision double, in a format that has it, may do"
                    : "");
    if (!repaired.certified)
        return settings.mode == tf::repair_mode::remove && std::isfinite(repaired.max_move)
                   ? "a hole could not be closed"
                   : "coordinates are too large";
    if (repaired.surface.faces.empty() && repaired.exact_faces > 0)
        return "nothing would be left: all of the exact result, " +
               counted(repaired.exact_faces, "face", "faces") + ", is thinner than " +
               (to_single ? "float32" : "double") + " numbers tell apart there" +
               (to_single ? "; --precision double may do" : "");
    if (repaired.surface.faces.empty() && !result.mesh.faces.empty())
        return std::string("nothing would be left") +
               (settings.mode == tf::repair_mode::outer
                    ? ": the faces cancel each other out and bound nothing"
                    : "") +
               "; --repair=split keeps one of each";
    if (repaired.max_move > allowed)
        return "a point would move by " + shortest(repaired.max_move) + ", more than " +
               shortest(allowed) + " (--max-move)";
    if (settings.keep_components && repaired.lost_components > 0)
        return counted(repaired.lost_components, "component", "components") +
               " would disappear (--keep-components)";
    return {};
}

void say_result(job& work, const repair_settings& settings, const tf::repaired_mesh& repaired) {
    std::string text = work.name + ": repaired (" + name_of(settings.mode) +
                       "): " + counted(repaired.surface.faces.size(), "face", "faces") +
                       ", no self-intersections";
    if (repaired.removed > 0)
        text += ", " + counted(repaired.removed, "face", "faces") + " removed";
    if (repaired.covered > 0)
        text += ", " + counted(repaired.covered, "face lies", "faces lie") + " on others";
    if (repaired.filled > 0) text += ", " + grouped(repaired.filled) + " filled in";
    if (repaired.left_open > 0)
        text += ", " + counted(repaired.left_open, "edge", "edges") + " left open";
    if (repaired.max_move > 0.0)
        text += ", rounding moved points by " + shortest(repaired.max_move) + " at most";
    work.out.result(text);
    if (repaired.lost_components > 0)
        work.warn("lost-components",
                  counted(repaired.lost_components, "component has", "components have") +
                      " disappeared" +
                      (settings.mode == tf::repair_mode::split && repaired.covered > 0
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
        elements.push_back(index == tf::repaired_mesh::none ? tf::operand_element{}
                                                            : tf::operand_element{0, index});
    return elements;
}

/// The face that each one lies in, -1 where it fills a hole.
void add_source_faces(tf::mesh_file& file, const findings& result,
                      const std::vector<std::uint32_t>& face_of) {
    std::vector<std::int32_t> sources;
    for (const std::uint32_t f : face_of)
        sources.push_back(
            f == tf::repaired_mesh::none ? -1 : static_cast<std::int32_t>(result.stored_face(f)));
    tf::element& rows = tf::obtain_element(file.attributes, "face", file.mesh.faces.size());
    tf::set_column(rows, tf::make_column<std::int32_t>("source_face", sources));
}

void write_repaired(job& work, const tf::mesh_file& input, const findings& result,
                    tf::repaired_mesh& repaired, const std::filesystem::path& output,
                    const written_form& form, bool to_single) {
    const auto timing = work.time("write");
    tf::mesh_file file;
    file.mesh = std::move(repaired.surface);
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = to_single ? tf::precision::float32 : tf::precision::float64;
    const property_source whole{&input, &result.triangle_of_face};
    std::optional<tf::mesh_file> searched;
    if (input.mesh.points.size() != result.mesh.points.size())
        searched = with_searched_points(input, result);
    const property_source source{searched ? &*searched : &input, &result.triangle_of_face};
    carry_properties(file, {&source, 1}, {of_input(repaired.face_of), of_input(repaired.point_of)});
    if ((searched && points_have_properties({&whole, 1})) || leaves_out_properties({&whole, 1}))
        work.warn("attributes", "not all properties of the input are carried over");
    add_source_faces(file, result, repaired.face_of);
    const tf::write_result written = write_certified(work, file, form, output);
    work.entry["output"] = {{"file", output.string()},
                            {"format", written.format},
                            {"precision_out", to_single ? "float" : "double"},
                            {"max_move", written.largest_move}};
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
}

}  // namespace

const char* name_of(tf::repair_mode mode) {
    switch (mode) {
        case tf::repair_mode::split:
            return "split";
        case tf::repair_mode::outer:
            return "outer";
        case tf::repair_mode::remove:
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
    tf::repaired_mesh repaired = compute(work, result, settings, to_single);
    const std::uint64_t separated = settings.mode == tf::repair_mode::outer && repaired.certified
                                        ? separate_parts(repaired)
                                        : 0;
    const double allowed = settings.max_move.used(result.box ? tf::diagonal(*result.box) : 0.0);
    enter_repair(work, result, settings, repaired, allowed, to_single);
    work.entry["repair"]["separated_points"] = separated;
    if (const std::string why = objection(result, settings, repaired, allowed, to_single);
        !why.empty()) {
        work.out.result(work.name + ": not repaired, nothing written: " + why);
        return false;
    }
    say_result(work, settings, repaired);
    warn_of_moves(work, repaired.surface.points, repaired.max_move, to_single);
    if (output && !work.options.dry_run)
        write_repaired(work, file, result, repaired, *output, *form, to_single);
    return true;
}

}  // namespace tools
