#include "tools/tf-boolean/outputs.hpp"

#include "tools/common/certified_output.hpp"
#include "tools/common/console.hpp"
#include "tools/common/curve_file.hpp"
#include "tools/common/material_words.hpp"
#include "tools/common/output_file.hpp"
#include "tools/tf-boolean/words.hpp"
#include <libmesh/base/point_math.hpp>
#include <libmesh/round/rounding_defects.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace tools {
namespace {

/// Of the faces that meet each other, where the first of them is.
json meeting_list(const tf::boolean_result& result) {
    json list = json::array();
    for (const auto& [f, g] : result.certificate.meeting) {
        const tf::point3& at = result.mesh.points[result.mesh.faces[f][0]];
        list.push_back({{"faces", {f, g}}, {"near", {at.x, at.y, at.z}}});
    }
    return list;
}

bool printable(const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) >= 32; });
}

/// The columns P_mesh and P_face, and what the numbers of meshes stand for.
void add_sources(tf::mesh_file& file, const boolean_settings& settings,
                 const std::vector<solid>& solids, const tf::boolean_result& result) {
    std::vector<std::uint32_t> meshes, faces;
    for (const tf::operand_element& source : result.face_source) {
        meshes.push_back(source.operand);
        faces.push_back(solids[source.operand].stored_face(source.index));
    }
    tf::element& rows = tf::obtain_element(file.attributes, "face", file.mesh.faces.size());
    rows.columns.push_back(tf::make_column<std::uint32_t>(settings.source + "_mesh", meshes));
    rows.columns.push_back(tf::make_column<std::uint32_t>(settings.source + "_face", faces));
    for (std::size_t i = 0; i < solids.size(); ++i)
        if (printable(solids[i].path))
            file.attributes.comments.push_back(settings.source + "_mesh " + std::to_string(i) +
                                               " " + solids[i].path);
}

std::vector<const tf::mesh_file*> files_of(const std::vector<solid>& solids) {
    std::vector<const tf::mesh_file*> files;
    for (const solid& s : solids) files.push_back(&s.file);
    return files;
}

/// All inputs together give one result, so that none is replaced.
written_form form_of(const common_options& o) { return {mesh_format(o, o.output), o.ascii}; }

}  // namespace

void check_output_places(const job& work, const boolean_settings& settings) {
    const common_options& o = work.options;
    if (o.dry_run) return;
    for (const auto& path : {o.output, settings.curves})
        if (!path.empty()) check_output(path, o.force);
}

void enter_blank_report(job& work, const boolean_settings& settings) {
    json& entry = work.entry;
    entry["operation"] = settings.name().empty() ? json(nullptr) : json(settings.name());
    entry["inside"] = name_of(settings.inside);
    entry["check"] = settings.check;
    entry["inputs"] = json::array();
    for (const char* key : {"pairs", "cut_faces", "cells", "volumes", "separated_points"})
        entry[key] = nullptr;
    entry["skipped"] = {{"degenerate", nullptr}, {"faces_not_cut", nullptr}};
    entry["max_move"] = {
        {"given", settings.max_move ? json(settings.max_move->given) : json(nullptr)},
        {"used", nullptr}};
    entry["output"] = nullptr;
}

bool writes_single(const job& work, const std::vector<solid>& solids) {
    const common_options& o = work.options;
    return writes_single(o, o.output.empty() ? std::nullopt : std::optional(form_of(o)),
                         files_of(solids));
}

void enter_result(job& work, const tf::boolean_result& result, bool bounds_solid, bool to_single) {
    json& entry = work.entry;
    std::uint64_t triangles = 0;
    for (const json& input : entry["inputs"]) triangles += input["triangles"].get<std::uint64_t>();
    entry["pairs"] = result.statistics.pairs;
    entry["cut_faces"] = result.statistics.cut_faces;
    entry["cells"] = result.statistics.cells > 0 ? json(result.statistics.cells) : json(nullptr);
    if (bounds_solid && result.certificate)
        entry["separated_points"] = result.statistics.split_vertices;
    if (result.volumes) {
        const auto& [first, second, either, both] = *result.volumes;
        entry["volumes"] = {{"first", first},
                            {"second", second},
                            {"union", either},
                            {"intersection", both},
                            {"error", (first - either) + (second - both)}};
    }
    entry["skipped"] = {
        {"degenerate", result.statistics.degenerate},
        {"faces_not_cut", triangles - std::min(triangles, result.statistics.cut_faces)}};
    json places = json::array();
    for (const tf::point3& p : result.vanished_at) places.push_back({p.x, p.y, p.z});
    const tf::mesh& surface = result.mesh;
    const auto topology = tf::count_topology(surface.points.size(), surface.faces);
    const auto cut =
        std::count(result.vertex_source.begin(), result.vertex_source.end(), tf::operand_element{});
    entry["output"] = {{"file", nullptr},
                       {"format", nullptr},
                       {"precision_out", to_single ? "float" : "double"},
                       {"vertices", surface.points.size()},
                       {"cut_vertices", cut},
                       {"faces", surface.faces.size()},
                       {"components", topology.components_by_point},
                       {"nonmanifold_edges", topology.nonmanifold_edges},
                       {"volume", bounds_solid ? json(tf::signed_volume(surface)) : json(nullptr)},
                       {"closed", bounds_solid ? json(true) : json(topology.boundary_edges == 0)},
                       {"oriented", bounds_solid ? json(true) : json(nullptr)},
                       {"self_intersections", result.certificate.meeting_count},
                       {"meeting", meeting_list(result)},
                       {"exact_faces", result.statistics.exact_faces},
                       {"lost_parts", {{"count", result.vanished_components}, {"list", places}}},
                       {"certified", static_cast<bool>(result.certificate)},
                       {"max_move", result.certificate.max_displacement},
                       {"step", tf::coordinate_step(surface.points, to_single)},
                       {"rounding_steps", result.statistics.rounding_steps}};
}

void write_surface(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                   tf::boolean_result& result, bool to_single) {
    const common_options& o = work.options;
    if (o.output.empty() || o.dry_run) return;
    const auto timing = work.time("write");
    tf::mesh_file file;
    file.mesh = std::move(result.mesh);
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = to_single ? tf::precision::float32 : tf::precision::float64;
    const written_form form = form_of(o);
    if (!settings.no_attributes)
        tf::carry(file, sources_of(solids),
                  {result.face_source, result.vertex_source, result.face_of_cut_vertex});
    if (!settings.no_attributes && form.format == "obj")
        warn_of_ambiguous_materials(work, files_of(solids));
    if (holds_sources(form.format)) add_sources(file, settings, solids, result);
    const tf::write_result written = write_certified(work, file, form, o.output);
    work.entry["output"]["file"] = o.output.string();
    work.entry["output"]["format"] = written.format;
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
}

void write_curves(job& work, const boolean_settings& settings, const std::vector<solid>& solids) {
    if (settings.curves.empty() || work.options.dry_run) return;
    tf::mesh all;
    pair_numbers first_mesh{settings.source + "_mesh1", {}};
    pair_numbers second_mesh{settings.source + "_mesh2", {}};
    std::vector<std::uint32_t> mesh_of_face;
    for (std::uint32_t i = 0; i < solids.size(); ++i) {
        const tf::mesh& one = solids[i].file.mesh;
        const auto offset = static_cast<std::uint32_t>(all.points.size());
        for (const tf::point3& p : one.points)  // none of the faces has one that is not finite
            all.points.push_back(tf::detail::base::is_finite(p) ? p : tf::point3{});
        for (const auto& [a, b, c] : one.faces) {
            all.faces.push_back({a + offset, b + offset, c + offset});
            mesh_of_face.push_back(i);
        }
    }
    all = tf::join_equal_points(all);
    const auto found = tf::self_intersections(
        all, {.vertices = tf::vertex_identity::by_index, .progress = work.progress("curves")});
    work.out.end_progress();
    work.keeper.check();
    if (found.cancelled) throw failure(stopped, "stopped", work.name + ": stopped");
    for (const tf::face_pair& pair : found.pairs) {
        first_mesh.of_pair.push_back(mesh_of_face[pair.a]);
        second_mesh.of_pair.push_back(mesh_of_face[pair.b]);
    }
    output_file file(settings.curves, work.options.force, work.keeper);
    write_curves(file, all, found.pairs, {std::move(first_mesh), std::move(second_mesh)},
                 curves_as_ply(settings.curves));
    file.commit();
}

}  // namespace tools
