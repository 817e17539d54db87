#include "tools/tf-selfintersect/search.hpp"

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace tools {
namespace {

/// The faces of `mesh` that are not listed, both ascending.
std::vector<std::uint32_t> all_but(std::size_t faces, const std::vector<std::uint32_t>& listed) {
    std::vector<std::uint32_t> all(faces);
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> rest;
    rest.reserve(faces - listed.size());
    std::set_difference(all.begin(), all.end(), listed.begin(), listed.end(),
                        std::back_inserter(rest));
    return rest;
}

/// Cuts the search down to the faces listed.
void keep_only(findings& result, std::vector<std::uint32_t> faces) {
    result.mesh = tf::select_faces(result.mesh, faces);
    if (!result.component.empty())
        for (std::size_t f = 0; f < faces.size(); ++f)
            result.component[f] = result.component[faces[f]];
    if (!result.component.empty()) result.component.resize(faces.size());
    if (!result.triangle_of_face.empty())
        for (std::uint32_t& f : faces) f = result.triangle_of_face[f];
    result.triangle_of_face = std::move(faces);
}

void drop_unusable_faces(job& work, findings& result) {
    const tf::mesh_defects defects = tf::find_defects(result.mesh);
    result.degenerate = defects.degenerate_faces.size();
    result.non_finite = defects.nonfinite_faces.size();
    std::vector<std::uint32_t> unusable;
    std::merge(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(),
               defects.out_of_range_faces.begin(), defects.out_of_range_faces.end(),
               std::back_inserter(unusable));
    if (result.non_finite > 0)
        work.warn("non-finite", counted(result.non_finite, "face", "faces") +
                                    " with a NaN or infinite coordinate left out");
    if (!unusable.empty() || !defects.nonfinite_points.empty())
        keep_only(result, all_but(result.mesh.faces.size(), unusable));
    if (result.mesh.faces.empty())
        throw failure(bad_input, "no-triangles",
                      work.name + ": no triangle with finite coordinates");
}

void join_corners(job& work, findings& result, const search_settings& settings, bool equal) {
    const double length = settings.tolerance.used(result.box ? tf::diagonal(*result.box) : 0.0);
    result.tolerance_used = length;
    const bool detailed = work.options.detailed();
    if (equal || length > 0.0) {
        result.mesh = tf::join_equal_points(result.mesh);
        result.points_distinct = result.mesh.points.size();
    } else if (detailed) {
        result.points_distinct = tf::find_equal_points(result.mesh.points).first_of_new.size();
    }
    if (!(length > 0.0)) return;
    const std::size_t before = result.mesh.points.size();
    result.mesh =
        tf::join_groups(result.mesh, tf::group_points(result.mesh.points, {.tolerance = length}));
    result.corners_joined = before - result.mesh.points.size();
}

tf::self_intersection_options library_options(job& work, const findings& result,
                                              const search_settings& settings) {
    tf::self_intersection_options options;
    options.vertices = tf::vertex_identity::by_index;  // joined as asked
    options.first_only = settings.first;
    for (std::size_t k = 0; k < tf::pair_kind_count; ++k)
        if (const auto kind = static_cast<tf::pair_kind>(k); !settings.looks_for(kind))
            options.kinds = options.kinds - kind;
    options.between = settings.between;
    options.within = settings.within;
    if (settings.between || settings.within) options.component_of_face = result.component;
    options.progress = work.progress("pairs");
    return options;
}

}  // namespace

bool search_settings::counts(tf::pair_kind kind) const {
    switch (kind) {
        case tf::pair_kind::crossing:
        case tf::pair_kind::pierce:
            return true;
        case tf::pair_kind::overlap:
        case tf::pair_kind::fold:
        case tf::pair_kind::duplicate:
            return !no_overlap;
        case tf::pair_kind::touching:
        case tf::pair_kind::degenerate:
            return touching;
    }
    return false;
}

bool search_settings::looks_for(tf::pair_kind kind) const {
    return counts(kind) || (kind == tf::pair_kind::degenerate && !first);
}

std::vector<std::uint32_t> findings::faces_hit() const {
    std::vector<std::uint32_t> faces;
    faces.reserve(2 * found.pairs.size());
    for (const tf::face_pair& pair : found.pairs) {
        faces.push_back(pair.a);
        faces.push_back(pair.b);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

findings search(job& work, tf::mesh_file& file, const search_settings& settings, bool keep_mesh) {
    findings result;
    result.faces_stored = file.stored_faces;
    result.triangles = file.mesh.faces.size();
    result.points_stored = file.mesh.points.size();
    if (file.mesh.faces.empty())
        throw failure(bad_input, "no-triangles",
                      work.name + ": no triangles (" +
                          counted(file.mesh.points.size(), "point", "points") + ")");
    result.stored_face_of_triangle = file.stored_face;
    result.box = tf::bounding_box(file.mesh.points);
    result.mesh = keep_mesh ? file.mesh : std::move(file.mesh);

    {
        const job::timer timing = work.time("prepare");
        drop_unusable_faces(work, result);
        work.keeper.check();
        const bool equal = settings.vertices == vertex_mode::equal ||
                           (settings.vertices == vertex_mode::by_format && !file.indexed);
        join_corners(work, result, settings, equal);
        work.keeper.check();
        if (settings.between || settings.within || work.options.detailed())
            result.component = tf::face_components(result.mesh.points.size(), result.mesh.faces);
        if (settings.box)
            keep_only(result, tf::faces_in_box(result.mesh, settings.box->min, settings.box->max));
        work.keeper.check();
    }

    result.found = tf::self_intersections(result.mesh, library_options(work, result, settings));
    work.out.end_progress();
    work.seconds["tree"] += result.found.tree_seconds;
    work.seconds["pairs"] += result.found.pair_seconds;
    work.keeper.check();
    std::erase_if(result.found.pairs,
                  [&](const tf::face_pair& pair) { return !settings.counts(pair.kind); });
    const job::timer timing = work.time("regions");
    result.regions = tf::group_pairs(result.mesh, result.found.pairs);
    return result;
}

std::optional<near_points> nearly_equal_points(const findings& result) {
    constexpr std::size_t most = 1'000'000;
    if (!result.box || result.tolerance_used > 0.0 || result.mesh.points.size() > most)
        return std::nullopt;
    near_points near;
    near.within = 1e-6 * tf::diagonal(*result.box);
    const auto distinct = tf::find_equal_points(result.mesh.points).first_of_new.size();
    const auto apart =
        tf::group_points(result.mesh.points, {.tolerance = near.within}).first_of_group.size();
    near.count = distinct - apart;
    return near;
}

}  // namespace tools
