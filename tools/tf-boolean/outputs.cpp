#include "tools/tf-boolean/outputs.hpp"

#include "tools/common/carried_properties.hpp"
#include "tools/common/certified_output.hpp"
#include "tools/common/console.hpp"
#include "tools/common/output_file.hpp"
#include <libmesh/topology.hpp>
#include <libmesh/volume.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace tools {
namespace {

/// Of the faces that meet each other, where the first of them is.
json meeting_list(const tf::solid_result& result) {
    json list = json::array();
    for (const auto& [f, g] : result.meeting_faces) {
        const tf::point3& at = result.surface.points[result.surface.faces[f][0]];
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
                 const std::vector<solid>& solids, const tf::solid_result& result) {
    std::vector<std::uint32_t> meshes, faces;
    for (const tf::operand_element& source : result.source_face) {
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

}  // namespace

void check_output_places(const job& work) {
    const common_options& o = work.options;
    if (!o.output.empty() && !o.dry_run) check_output(o.output, o.force);
}

void enter_blank_report(job& work, const boolean_settings& settings) {
    json& entry = work.entry;
    entry["operation"] = settings.name().empty() ? json(nullptr) : json(settings.name());
    entry["inside"] = name_of(settings.inside);
    entry["check"] = settings.check;
    entry["inputs"] = json::array();
    for (const char* key : {"pairs", "cut_faces", "cells"}) entry[key] = nullptr;
    entry["skipped"] = {{"degenerate", nullptr}, {"faces_not_cut", nullptr}};
    entry["max_move"] = {
        {"given", settings.max_move ? json(settings.max_move->given) : json(nullptr)},
        {"used", nullptr}};
    entry["output"] = nullptr;
    entry["warnings"] = json::array();
}

bool writes_single(const job& work, const std::vector<solid>& solids) {
    const common_options& o = work.options;
    return writes_single(o, o.output.empty() ? std::nullopt : std::optional(o.output),
                         sources_of(solids));
}

void enter_result(job& work, const boolean_settings& settings, const tf::solid_result& result,
                  bool to_single) {
    json& entry = work.entry;
    std::uint64_t triangles = 0;
    for (const json& input : entry["inputs"]) triangles += input["triangles"].get<std::uint64_t>();
    entry["pairs"] = result.pairs;
    entry["cut_faces"] = result.cut_faces;
    entry["cells"] = settings.splits() ? json(nullptr) : json(result.cells);
    entry["skipped"] = {{"degenerate", result.degenerate},
                        {"faces_not_cut", triangles - std::min(triangles, result.cut_faces)}};
    const tf::mesh& surface = result.surface;
    const auto topology = tf::count_topology(surface.points.size(), surface.faces);
    const auto cut =
        std::count(result.source_point.begin(), result.source_point.end(), tf::operand_element{});
    const bool solid = !settings.splits();
    entry["output"] = {{"file", nullptr},
                       {"format", nullptr},
                       {"precision_out", to_single ? "float" : "double"},
                       {"vertices", surface.points.size()},
                       {"cut_vertices", cut},
                       {"faces", surface.faces.size()},
                       {"components", topology.components_by_point},
                       {"nonmanifold_edges", topology.nonmanifold_edges},
                       {"volume", solid ? json(tf::signed_volume(surface)) : json(nullptr)},
                       {"closed", solid ? json(true) : json(topology.boundary_edges == 0)},
                       {"oriented", solid ? json(true) : json(nullptr)},
                       {"self_intersections", result.meeting_count},
                       {"meeting", meeting_list(result)},
                       {"certified", result.certified},
                       {"max_move", result.max_move},
                       {"rounding_steps", result.rounding_steps}};
}

void write_surface(job& work, const boolean_settings& settings, const std::vector<solid>& solids,
                   tf::solid_result& result, bool to_single) {
    const common_options& o = work.options;
    if (o.output.empty() || o.dry_run) return;
    const auto timing = work.time("write");
    tf::mesh_file file;
    file.mesh = std::move(result.surface);
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = to_single ? tf::precision::single_ : tf::precision::double_;
    const std::string format = mesh_format(o, o.output);
    if (!settings.no_attributes)
        carry_properties(file, sources_of(solids), result.source_face, result.source_point);
    if (format == "ply") add_sources(file, settings, solids, result);
    const tf::write_result written = write_certified(work, file, o.output);
    work.entry["output"]["file"] = o.output.string();
    work.entry["output"]["format"] = written.format;
    for (const tf::io_warning& w : written.warnings) work.warn(w.code, w.text);
}

}  // namespace tools
