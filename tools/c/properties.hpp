#pragma once
/// \file
/// Properties of meshes, features, convex hulls and predicates, in C.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>

namespace glue {

/// Returns `value`, after checking that all points are finite, which the library requires.
inline double of_finite(const treeform_mesh* mesh, double (*value)(const tf::mesh_ref&)) {
    const double result = value(view(mesh));
    return std::isfinite(result) ? result : value(finite_view(mesh));
}

/// The volume inside a closed mesh, in cubic units; negative if it is inside out. For an open mesh,
/// the sum of the signed volumes of the tetrahedra from the origin to its faces. O(F).
inline double signed_volume(const treeform_mesh* mesh) {
    return of_finite(mesh, tf::signed_volume);
}

/// The sum of the areas of all faces, in square units, rounded. O(F).
inline double surface_area(const treeform_mesh* mesh) { return of_finite(mesh, tf::surface_area); }

/// Volume, center of mass and inertia of the solid that a closed mesh bounds. If the volume is 0,
/// or too small compared with the terms of its sum, it is 0, and the others are NaN. O(F).
inline treeform_mass_properties find_mass_properties(const tf::mesh_ref& mesh) {
    constexpr std::array none{not_known, not_known, not_known};
    treeform_mass_properties to{};
    keeper kept;
    fill(kept,
         tf::find_mass_properties(mesh).value_or(
             tf::mass_properties{0.0, nowhere, {none, none, none}}),
         to);
    return to;
}

/// The smallest box around all finite points; if there are none, min is +infinity and max
/// -infinity. O(V).
inline treeform_box bounding_box(tf::mesh_view mesh) {
    constexpr tf::box3 none{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    return copied(tf::bounding_box(mesh.points).value_or(none));
}

/// Whether the mesh is a solid: closed, oriented, manifold, free of self-intersections.
inline bool is_solid(const tf::mesh_ref& mesh) { return !tf::find_solid_defects(mesh).any(); }

/// Counts edges, components and defects. Join equal points first (`treeform_join_equal_points`).
inline tf::topology_counts count_topology(tf::mesh_view mesh) {
    return tf::count_topology(mesh.points.size(), mesh.faces);
}

/// `component` [F]: the connected component of each face, by shared corners; components are
/// numbered in the order of their lowest faces. `count` is their number.
inline void face_components(tf::mesh_view mesh, std::uint32_t* component, std::size_t* count) {
    const std::span out = array(component, mesh.faces.size(), "component");
    (void)need(count, "count");
    const auto found = tf::face_components(mesh.points.size(), mesh.faces);
    std::copy(found.begin(), found.end(), out.begin());
    *count = found.empty() ? 0 : *std::max_element(found.begin(), found.end()) + std::size_t{1};
}

/// The point numbers of the lowest edge at which the mesh is open; both `TREEFORM_NONE` if the mesh
/// is closed, so that winding numbers are defined.
inline void find_open_edge(tf::mesh_view mesh, std::uint32_t edge[2]) {
    (void)need(edge, "edge");
    const auto found = tf::find_open_edge(mesh).value_or(std::array{TREEFORM_NONE, TREEFORM_NONE});
    edge[0] = found[0];
    edge[1] = found[1];
}

/// `result` is the index of the first of `tolerances` [count] that closes the mesh if points within
/// it are joined; `count` if joining equal points already closes it, or if none does.
inline std::size_t closing_tolerance(tf::mesh_view mesh, std::span<const double> tolerances) {
    return tf::closing_tolerance(mesh, tolerances).value_or(tolerances.size());
}

// ---- features ----

/// The flat or cylindrical regions of the mesh, largest first. Join equal points first.
inline std::vector<tf::mesh_feature> find_features(tf::mesh_view mesh, tf::feature_kind kind,
                                                   const treeform_feature_options* options) {
    tf::feature_options how = read(options);
    bool stopped = false;
    if (const auto report = how.progress ? how.progress : thread_progress())
        how.progress = [&stopped, report](double done) {
            stopped = !report(done);
            return !stopped;
        };
    auto found = tf::find_features(mesh, kind, how);
    if (stopped) throw cancelled{};
    return found;
}

/// The region around a face; `count` is 0 if it is neither flat nor cylindrical.
inline std::optional<tf::mesh_feature> feature_at_face(tf::mesh_view mesh, tf::feature_kind kind,
                                                       std::uint32_t face,
                                                       const tf::feature_options& options) {
    return tf::feature_at(mesh, kind, face, options);
}

/// The region around the face nearest to a point.
inline std::optional<tf::mesh_feature> feature_at_point(tf::mesh_view mesh, tf::feature_kind kind,
                                                        const tf::point3& point,
                                                        const tf::feature_options& options) {
    const auto at = tf::closest_point(mesh, point);
    return at ? tf::feature_at(mesh, kind, at->face, options) : std::nullopt;
}

// ---- convex hulls, predicates ----

/// The convex hull of the points of a mesh or cloud, exact on the coordinates as given. `progress`
/// may be null.
inline answer_of<treeform_hull> convex_hull(tf::mesh_view mesh,
                                            const tf::progress_callback& progress) {
    auto made = make<treeform_hull>();
    const auto& found = made->keep(tf::convex_hull(mesh.points, progress));
    check(found.status);
    treeform_hull& h = made->value;
    h.dimension = found.dimension;
    h.faces = arrays({mesh.points, found.faces}).faces;
    h.face_count = found.faces.size();
    h.sides = same<treeform_hull_side>(found.sides);
    h.side_count = found.sides.size();
    auto& begin = made->keep(std::vector<std::size_t>{0});
    auto& corners = made->keep(std::vector<std::uint32_t>());
    for (const tf::hull_side& side : found.sides) {
        const auto of_side = found.corners_of(side, mesh.points);
        corners.insert(corners.end(), of_side.begin(), of_side.end());
        begin.push_back(corners.size());
    }
    h.corner_begin = begin.data();
    h.corners = corners.data();
    h.mesh = arrays(made->keep(found.mesh(mesh.points)));
    return made;
}

/// The intersection of triangles `a` and `b`, three points each; exact.
inline treeform_triangle_contact intersect_triangles(const double a[9], const double b[9]) {
    const auto triangle = [](const double* data, const char* name) {
        (void)need(data, name);
        return tf::triangle3{finite(data, name), finite(data + 3, name), finite(data + 6, name)};
    };
    const tf::triangle_contact found = tf::intersect(triangle(a, "a"), triangle(b, "b"));
    return {std::min<std::int32_t>(found.count, 3) - 1, found.coplanar, found.crossing};
}

}  // namespace glue
