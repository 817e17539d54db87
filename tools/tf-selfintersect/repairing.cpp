#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/shell/usable_input.hpp"
#include "tools/tf-selfintersect/outputs.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tools {
namespace {

/// Merging is not to lose what is written of vertices and faces.
bool keeps_cuts(const tf::mesh_file& input, const repair_settings& settings) {
    if (settings.keep_cuts || settings.mode != tf::resolve_mode::outer) return true;
    const tf::attribute_source source{&input, {}};
    return tf::attribute_sources(source).merging_mixes_values();
}

tf::repair_result compute(job& work, const tf::mesh_file& input, const findings& result,
                          const repair_settings& settings, tf::precision precision) {
    check_arrangeable(work.name, result.part.mesh);
    const auto timing = work.time("repair");
    tf::repair_result repaired = tf::resolve_self_intersections(
        result.part.mesh, settings.mode,
        {.fill_rule = settings.fill_rule,
         .precision = precision,
         .max_displacement = settings.limits.max_move.used(result.diagonal()),
         .keep_cuts = keeps_cuts(input, settings),
         .touching = settings.touching,
         .max_loss = settings.limits.loss(),
         .progress = work.progress("repair")});
    work.call_ended(repaired.certificate.status == tf::status::cancelled);
    return repaired;
}

face_numbers numbers_in_file(const findings& result) {
    return [&result](std::uint32_t f) { return result.part.face_in_file(f); };
}

void enter_repair(job& work, const findings& result, const repair_settings& settings,
                  const tf::repair_result& repaired) {
    const tf::mesh& surface = repaired.mesh;
    const tf::certificate& known = repaired.certificate;
    const auto topology = tf::count_topology(surface.points.size(), surface.faces);
    work.entry["repair"] = {
        {"mode", repair_modes[std::size_t(settings.mode)]},
        {"certified", static_cast<bool>(known)},
        {"self_intersections",
         {{"before", result.found.pairs.size()}, {"after", known.meeting_count}}},
        {"meeting", meeting_entry(known)},
        {"open", open_entry(known, numbers_in_file(result))},
        {"loss", loss_entry(known)},
        {"removed_faces", repaired.statistics.removed},
        {"covered_faces", repaired.statistics.covered},
        {"filled_faces", repaired.statistics.filled},
        {"left_open_edges", repaired.statistics.left_open},
        {"lost_components", repaired.statistics.vanished_components},
        {"volume",
         {{"before", tf::signed_volume(result.part.mesh)}, {"after", tf::signed_volume(surface)}}},
        {"precision_out", name_of(known.precision)},
        {"vertices", surface.points.size()},
        {"faces", surface.faces.size()},
        {"components", topology.components_by_point},
        {"boundary_edges", topology.boundary_edges},
        {"nonmanifold_edges", topology.nonmanifold_edges},
        {"separated_points", repaired.statistics.split_vertices}};
}

/// What helps against what the certificate says.
std::string remedy_for(const tf::certificate& known, tf::resolve_mode mode) {
    using enum tf::resolve_mode;
    const bool floats = known.precision == tf::precision::float32;
    if (known.status == tf::status::open_input)
        return "; --repair=split and --repair=remove accept open surfaces";
    if (known.status == tf::status::excessive_loss) return " (--accept-loss writes it)";
    if (known.vanished_faces > 0) return floats ? "; --precision double may help" : "";
    if (known.status == tf::status::vanished)
        return mode == outer
                   ? ": the faces cancel each other out and enclose no volume; --repair=split "
                     "keeps one of each"
                   : "; --repair=split keeps one of each";
    const bool by_rounding = known.meeting_count > 0 && mode != remove;
    return floats && by_rounding ? "; --precision double, in a format that has it, may help" : "";
}

/// Why the result cannot be taken; empty when it can.
std::string objection(const findings& result, const repair_settings& settings,
                      const tf::repair_result& repaired, std::string too_far) {
    const tf::certificate& known = repaired.certificate;
    if (!known)
        return (known.status == tf::status::open_input ? "it bounds no solid: " : "") +
               message_of(known, numbers_in_file(result)) + remedy_for(known, settings.mode);
    if (!too_far.empty()) return too_far;
    if (settings.keep_components && repaired.statistics.vanished_components > 0)
        return counted(repaired.statistics.vanished_components, "component", "components") +
               " would disappear (--keep-components)";
    return {};
}

void say_result(job& work, const repair_settings& settings, const tf::repair_result& repaired) {
    const tf::repair_statistics& did = repaired.statistics;
    std::string text = work.name + ": repaired (" + repair_modes[std::size_t(settings.mode)] +
                       "): " + counted(repaired.mesh.faces.size(), "face", "faces") +
                       ", no self-intersections";
    if (did.removed > 0) text += ", " + counted(did.removed, "face", "faces") + " removed";
    if (did.covered > 0)
        text += ", " + counted(did.covered, "face lies", "faces lie") + " on others";
    if (did.filled > 0) text += ", " + grouped(did.filled) + " filled in";
    if (did.left_open > 0) text += ", " + counted(did.left_open, "edge", "edges") + " left open";
    if (repaired.certificate.max_displacement > 0.0)
        text += ", rounding moved points by " + brief(repaired.certificate.max_displacement) +
                " at most";
    work.out.result(text);
    if (repaired.statistics.vanished_components > 0)
        work.warn(
            "lost-components",
            counted(repaired.statistics.vanished_components, "component has", "components have") +
                " disappeared" +
                (settings.mode == tf::resolve_mode::split && did.covered > 0
                     ? ", or lie entirely on others"
                     : ""));
}

/// The face that each one lies in, -1 where it fills a hole.
void add_source_faces(tf::mesh_file& file, const findings& result,
                      const std::vector<std::uint32_t>& face_of) {
    std::vector<std::int32_t> sources;
    sources.reserve(face_of.size());
    for (const std::uint32_t f : face_of)
        sources.push_back(f == tf::repair_result::none
                              ? -1
                              : static_cast<std::int32_t>(result.part.face_in_file(f)));
    file.attributes.find_or_add("face", file.mesh.faces.size())
        .set(tf::column::of<std::int32_t>("source_face", sources));
}

/// Gives `file` what the input has. What points have is left out where these were joined, for they
/// may stand for several.
void carry(job& work, tf::mesh_file& file, tf::mesh_file& input, const findings& result,
           const tf::repair_result& repaired) {
    const tf::attribute_source source{&input, result.part.triangle_of_face};
    bool all = !tf::attribute_sources(source).has_values_left_out();
    if (input.mesh.points.size() != result.part.mesh.points.size()) {
        all = all && !tf::attribute_sources(source).has_vertex_values();
        input.mesh = result.part.mesh;
        std::erase_if(input.attributes.elements,
                      [](const tf::element& e) { return e.name == "vertex"; });
    }
    tf::attribute_sources(source).transfer(file, repaired.face_source, repaired.vertex_source);
    if (!all) work.warn("attributes", "not all properties of the input are carried over");
}

}  // namespace

bool repair_and_write(job& work, tf::mesh_file& input, const findings& result,
                      const repair_settings& settings,
                      const std::optional<std::filesystem::path>& output) {
    std::optional<written_form> form;
    if (output) form = form_of(work, input, *output);
    const tf::mesh_file* const inputs = &input;
    tf::repair_result repaired =
        compute(work, input, result, settings, written_precision(work.options, form, {&inputs, 1}));
    enter_repair(work, result, settings, repaired);
    const std::string too_far =
        move_objection(work.entry["repair"], settings.limits, result.diagonal(),
                       repaired.certificate, repaired.mesh.points);
    if (const std::string why = objection(result, settings, repaired, too_far); !why.empty()) {
        work.out.result(work.name + ": not repaired, nothing written: " + why);
        return false;
    }
    say_result(work, settings, repaired);
    warn_of_moves(work, repaired.mesh.points, repaired.certificate);
    if (!output || work.options.dry_run) return true;
    const auto timing = work.time("write");
    tf::mesh_file file = file_of(std::move(repaired.mesh), repaired.certificate);
    carry(work, file, input, result, repaired);
    add_source_faces(file, result, repaired.face_source);
    write_certified(work, file, *form, *output, repaired.certificate.max_displacement);
    return true;
}

}  // namespace tools
