#include "tools/tf-boolean/outputs.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace tools {
namespace {

std::vector<const tf::mesh_file*> files_of(const std::vector<solid>& solids) {
    std::vector<const tf::mesh_file*> files(solids.size());
    std::ranges::transform(solids, files.begin(), [](const solid& s) { return &s.file; });
    return files;
}

/// All inputs together give one result, so that none is replaced.
written_form form_of(const common_options& o) { return {mesh_format(o, o.output), o.ascii}; }

/// What was left out and filled, where that was asked for.
void enter_choices(json& entry, const boolean_settings& settings, const std::vector<solid>& solids,
                   const tf::boolean_statistics& did) {
    if (settings.min_volume_given) {
        entry["min_volume"]["parts"] = did.small_parts;
        entry["min_volume"]["volume"] = did.small_volume;
    }
    if (settings.gap) {
        entry["gap"]["used"] = settings.gap->used(diagonal_of(solids));
        entry["gap"]["faces"] = did.filled_faces;
    }
}

}  // namespace

void enter_blank_report(job& work, const boolean_settings& settings) {
    json& entry = work.entry;
    entry["operation"] = settings.name().empty() ? json(nullptr) : json(settings.name());
    entry["fill_rule"] = name_of(settings.fill_rule);
    entry["check"] = settings.check;
    entry["inputs"] = json::array();
    for (const char* key : {"pairs", "cut_faces", "volumes", "separated_points"})
        entry[key] = nullptr;
    for (const char* key : {"degenerate", "faces_not_cut", "faces_not_tested"})
        entry["skipped"][key] = nullptr;
    entry["min_volume"] = {{"given", settings.min_volume}, {"parts", nullptr}, {"volume", nullptr}};
    entry["gap"] = {
        {"given", or_null(settings.gap.has_value(), settings.gap ? settings.gap->given : "")},
        {"used", nullptr},
        {"faces", nullptr}};
    entry["max_move"] = {{"given", settings.limits.max_move.given},
                         {"used", nullptr},
                         {"largest", nullptr},
                         {"step", nullptr}};
    entry["output"] = nullptr;
}

tf::precision written_precision(const job& work, const std::vector<solid>& solids) {
    std::optional<written_form> form;
    if (!work.options.output.empty()) form = form_of(work.options);
    return written_precision(work.options, form, files_of(solids));
}

void enter_result(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                  const tf::boolean_result& result, bool bounds_solid) {
    json& entry = work.entry;
    const tf::boolean_statistics& did = result.statistics;
    const tf::certificate& known = result.certificate;
    std::uint64_t triangles = 0;
    for (const json& i : entry["inputs"]) triangles += i["triangles"].get<std::uint64_t>();
    entry["pairs"] = did.pairs;
    entry["cut_faces"] = did.cut_faces;
    if (bounds_solid && known) entry["separated_points"] = did.split_vertices;
    if (known) enter_choices(entry, settings, solids, did);
    if (result.volumes) {
        const auto& [first, second, either, both] = *result.volumes;
        entry["volumes"] = {{"first", first},
                            {"second", second},
                            {"union", either},
                            {"intersection", both},
                            {"error", (first - either) + (second - both)}};
    }
    entry["skipped"] = {{"degenerate", did.degenerate},
                        {"faces_not_cut", or_null(did.filled_faces == 0,
                                                  triangles - std::min(triangles, did.cut_faces))},
                        {"faces_not_tested", did.skipped_faces}};
    const auto topology = tf::count_topology(result.mesh.points.size(), result.mesh.faces);
    // STL has no vertex numbers: who reads it joins equal corners. Many do so with other formats.
    std::uint64_t nonmanifold = topology.nonmanifold_edges;
    if (is_stl(work.options) || (bounds_solid && known)) {
        const tf::mesh seen = tf::join_equal_points(tf::mesh(result.mesh));
        if (seen.points.size() < result.mesh.points.size())
            nonmanifold = tf::count_topology(seen.points.size(), seen.faces).nonmanifold_edges;
    }
    entry["output"] = {
        {"file", nullptr},
        {"format", nullptr},
        {"precision_out", name_of(known.precision)},
        {"vertices", result.mesh.points.size()},
        {"cut_vertices", std::ranges::count(result.vertex_source, tf::operand_element{})},
        {"faces", result.mesh.faces.size()},
        {"components", topology.components_by_point},
        {"nonmanifold_edges", nonmanifold},
        {"volume", or_null(bounds_solid, bounds_solid ? tf::signed_volume(result.mesh) : 0.0)},
        {"closed", bounds_solid || topology.boundary_edges == 0},
        {"oriented", or_null(bounds_solid, true)},
        {"self_intersections", known.meeting_count},
        {"meeting", meeting_entry(known)},
        {"exact_faces", did.exact_faces},
        {"lost_parts",
         {{"count", result.vanished_components},
          {"list", result.vanished_at},
          {"distance", result.vanished_distance}}},
        {"certified", static_cast<bool>(known)},
        {"max_move", known.max_displacement},
        {"step", tf::coordinate_step(result.mesh.points, known.precision)},
        {"rounding_repairs", did.rounding_repairs},
        {"rounding_rounds", did.rounding_rounds}};
}

void write_surface(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                   tf::boolean_result& result) {
    const common_options& o = work.options;
    if (o.output.empty() || o.dry_run) return;
    const auto timing = work.time("write");
    const written_form form = form_of(o);
    tf::mesh_file file = file_of(std::move(result.mesh), result.certificate);
    if (!settings.no_attributes) {
        sources_of(solids).transfer(file, result.face_source, result.vertex_source,
                                    result.face_of_cut_vertex);
        if (form.format == "obj") warn_of_ambiguous_materials(work, files_of(solids));
    }
    if (holds_sources(form.format)) {
        std::vector<std::string> inputs(solids.size());
        std::ranges::transform(solids, inputs.begin(),
                               [](const solid& s) { return s.part.empty() ? s.path : name_of(s); });
        for (tf::operand_element& e : result.face_source)
            e.index = solids[e.operand].face_in_file(e.index);
        tf::set_source_columns(file, settings.source, result.face_source, inputs);
    }
    write_certified(work, file, form, o.output, result.certificate.max_displacement);
}

meetings meetings_of(job& work, const std::vector<solid>& solids) {
    meetings all{.joined = tf::join_meshes(views_of(solids))};
    auto found = tf::self_intersections(all.joined, {.vertices = tf::vertex_identity::by_index,
                                                     .progress = work.progress("curves")});
    work.call_ended(found.status == tf::status::cancelled);
    all.pairs = std::move(found.pairs);
    return all;
}

void write_curves(job& work, const boolean_settings& settings, const std::vector<solid>& solids) {
    if (settings.curves.empty() || work.options.dry_run) return;
    const meetings all = meetings_of(work, solids);
    std::vector<std::uint32_t> mesh_of_face;
    for (std::uint32_t i = 0; i < solids.size(); ++i)
        mesh_of_face.resize(mesh_of_face.size() + solids[i].file.mesh.faces.size(), i);
    tf::pair_column first{settings.source + "_mesh1", {}}, second{settings.source + "_mesh2", {}};
    for (const tf::face_pair& pair : all.pairs) {
        first.second.push_back(mesh_of_face[pair.a]);
        second.second.push_back(mesh_of_face[pair.b]);
    }
    write_curves(work, settings.curves, all.joined, all.pairs,
                 {std::move(first), std::move(second)});
}

}  // namespace tools
