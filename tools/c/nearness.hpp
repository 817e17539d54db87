#pragma once
/// \file
/// Nearest points, distances, inside and outside, and rays, in C.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/point_location.hpp>

#include <tools/c/made/structs.hpp>

#include <algorithm>

namespace glue {

// ---- distances ----

/// The points of the surface nearest to `queries` [count][3]: `faces` [count], `distances` [count],
/// `points` [count][3]. If none is within `radius` (may be infinite), these are `TREEFORM_NONE`,
/// infinite and NaN. Of several faces at the same distance, the lowest.
inline void closest_point(const treeform_mesh* mesh, const double* queries, std::size_t count,
                          double radius, std::uint32_t* faces, double* distances, double* points) {
    const tf::points_view from = glue::points(queries, count, "queries");
    const tf::mesh_ref m = ref_for_pieces(mesh, "mesh");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        const auto some = tf::closest_point(m, from.subspan(begin, end - begin), radius);
        for (std::size_t i = begin; i < end; ++i) {
            const auto& found = some[i - begin];
            if (faces) faces[i] = found ? found->face : TREEFORM_NONE;
            if (distances) distances[i] = found ? found->distance : infinity;
            if (points) copy(found ? found->point : nowhere, points + 3 * i);
        }
    });
}

/// The nearest points of the surfaces `a` and `b`, each moved by a matrix (null: not moved), at
/// most `radius` apart.
inline treeform_closest closest_pair(const tf::mesh_ref& a, const tf::mesh_ref& b,
                                     const tf::transform<3>& transform_a,
                                     const tf::transform<3>& transform_b, double radius) {
    return same<treeform_closest>(
        tf::closest_pair(a, b, {transform_a, transform_b, radius})
            .value_or(
                tf::closest_pair_result{TREEFORM_NONE, TREEFORM_NONE, infinity, nowhere, nowhere}));
}

/// The distance of the surfaces; infinite if one has no faces.
inline double distance(const tf::mesh_ref& a, const tf::mesh_ref& b,
                       const tf::transform<3>& transform_a, const tf::transform<3>& transform_b) {
    return tf::distance(a, b, tf::mesh_pair_options{transform_a, transform_b});
}

/// The same for many positions, in parallel: `transforms_a` and `transforms_b` are [count][12], or
/// null if the mesh is not moved; `distances` [count] are infinite beyond `radius`.
/// Surfaces count; for solids, `treeform_check_poses`.
inline void distance_poses(const treeform_mesh* a, const treeform_mesh* b,
                           const double* transforms_a, const double* transforms_b,
                           std::size_t count, double radius, double* distances) {
    const std::span out = array(distances, count, "distances");
    in_positions(
        a, b, transforms_a, transforms_b, count,
        [&](const auto& x, const auto& y, auto where) { return tf::distance(x, y, where); }, out,
        radius);
}

// ---- inside and outside ----

template <class T>
T* from(T* array, std::size_t begin) {
    return array ? array + begin : nullptr;
}

inline void answer_all(std::span<const tf::point_location> found, std::uint8_t* where,
                       std::int32_t* winding, std::uint32_t* on) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (where) where[i] = static_cast<std::uint8_t>(found[i].where);
        if (winding) winding[i] = found[i].winding;
        if (on) on[i] = found[i].where == tf::location::boundary ? found[i].on : TREEFORM_NONE;
    }
}

/// The positions of `points` [count][3] relative to a closed mesh, exactly. `where` [count] is a
/// `treeform_location` for each; `winding` [count] how often the surface winds around the point;
/// `on` [count] the lowest face that contains a point on the boundary, else `TREEFORM_NONE`.
/// Returns `TREEFORM_INVALID`, naming an edge, if the mesh is open.
inline void locate(const treeform_mesh* mesh, const double* points, std::size_t count,
                   std::uint8_t* where, std::int32_t* winding, std::uint32_t* on) {
    const tf::points_view all = glue::points(points, count, "points");
    const tf::mesh_ref m = ref_for_pieces(mesh, "mesh");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        answer_all(tf::locate(m, all.subspan(begin, end - begin)), from(where, begin),
                   from(winding, begin), from(on, begin));
    });
}

/// `inside` [count]: 1 for points inside the closed mesh or on its surface, else 0.
inline void contains(const treeform_mesh* mesh, const double* points, std::size_t count,
                     std::uint8_t* inside) {
    const std::span out = array(inside, count, "inside");
    locate(mesh, points, count, inside, nullptr, nullptr);
    for (std::uint8_t& one : out) one = one == TREEFORM_OUTSIDE ? 0 : 1;
}

/// `winding` [count]: how often the surface winds around each point; 0 on the surface.
inline void winding_number(const treeform_mesh* mesh, const double* points, std::size_t count,
                           std::int32_t* winding) {
    (void)array(winding, count, "winding");
    locate(mesh, points, count, nullptr, winding, nullptr);
}

/// Like `treeform_locate`, for closed curves in the plane: `points` [point_count][2], `edges`
/// [edge_count][2] by point numbers, with the inside on their left; `queries` [count][2].
inline void locate_in_curves(const double* points, std::size_t point_count,
                             const std::uint32_t* edges, std::size_t edge_count,
                             const double* queries, std::size_t count, std::uint8_t* where,
                             std::int32_t* winding) {
    const tf::curve_locator locator(rows_of<tf::point2>(points, point_count, "points"),
                                    rows_of<tf::curve_edge>(edges, edge_count, "edges"));
    const auto all = rows_of<tf::point2>(queries, count, "queries");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        answer_all(locator.locate(all.subspan(begin, end - begin)), from(where, begin),
                   from(winding, begin), nullptr);
    });
}

// ---- rays ----

/// `ask(mesh, rays, begin)` for all rays.
template <class Ask>
void along_rays(const treeform_mesh* mesh, const treeform_ray* rays, std::size_t count,
                const Ask& ask) {
    const auto all = same_as<tf::ray3>(array(rays, count, "rays"));
    const tf::mesh_ref m = ref_for_pieces(mesh, "mesh");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        ask(m, all.subspan(begin, end - begin), begin);
    });
}

/// `hits` [count]: the first face that each ray hits, exactly; of several faces at the same point,
/// the lowest. For a ray that hits none, `face` is `TREEFORM_NONE`, `t` and `t_end` are NaN.
inline void raycast(const treeform_mesh* mesh, const treeform_ray* rays, std::size_t count,
                    treeform_mesh_hit* hits) {
    const std::span out = array(hits, count, "hits");
    along_rays(mesh, rays, count, [&](const auto& m, auto some, std::size_t begin) {
        for (const auto& found : tf::raycast(m, some))
            out[begin++] = found ? same<treeform_mesh_hit>(*found)
                                 : treeform_mesh_hit{TREEFORM_NONE, 0, 0, not_known, not_known};
    });
}

/// `hit` [count]: 1 if the ray hits any face, else 0.
inline void raycast_any(const treeform_mesh* mesh, const treeform_ray* rays, std::size_t count,
                        std::uint8_t* hit) {
    const std::span out = array(hit, count, "hit");
    along_rays(mesh, rays, count, [&](const auto& m, auto some, std::size_t begin) {
        const auto found = tf::raycast_any(m, some);
        std::copy(found.begin(), found.end(), out.data() + begin);
    });
}

/// All faces that each ray hits, in the exact order along the ray, then by number.
inline answer_of<treeform_hits> raycast_all(const treeform_mesh* mesh, const treeform_ray* rays,
                                            std::size_t count) {
    auto made = make<treeform_hits>();
    auto& found = made->keep(tf::answer_lists<tf::mesh_hit>{{0}, {}});
    along_rays(mesh, rays, count, [&](const auto& m, auto some, std::size_t) {
        auto more = tf::raycast_all(m, some);
        append(found.begin, found.answers, std::move(more.begin), std::move(more.answers));
    });
    made->value.begin = found.begin.data();
    made->value.hits = same<treeform_mesh_hit>(found.answers);
    made->value.count = count;
    return made;
}

// ---- two meshes ----

/// Only the relation, exactly: disjoint, touching or penetrating.
inline tf::mesh_relation relation(const tf::mesh_ref& a, const tf::mesh_ref& b,
                                  tf::vertex_identity vertices) {
    return tf::relation(a, b, {.vertices = vertices}).relation;
}

/// `depth` is the length of a short translation `move` that separates `a` from `b`, verified
/// exactly: an upper bound of the penetration depth. Both are 0 if the meshes do not penetrate each
/// other. `effort` is the effort of the search; may be null.
inline void penetration_depth(const tf::mesh_ref& a, const tf::mesh_ref& b,
                              const tf::measure_options& options, double* depth, double move[3],
                              treeform_search_effort* effort) {
    (void)need(depth, "depth");
    (void)need(move, "move");
    const auto found =
        tf::penetration_depth(a, b, options).value_or(tf::penetration_depth_result{});
    check(found.status);
    *depth = found.depth;
    copy(found.move, move);
    if (effort) *effort = same<treeform_search_effort>(found.effort);
}

/// Counts `points` [points_count][3] by their position relative to `solids` [solids_count],
/// exactly: counts[0] is the number of points strictly inside at least one solid, counts[1] that of
/// other points on a surface, counts[2] that of points outside all solids.
inline void count_sides(std::span<const tf::point3> points, const tf::mesh_refs& solids,
                        std::uint64_t counts[3]) {
    (void)need(counts, "counts");
    const auto found = tf::count_sides(points, solids);
    std::copy(found.begin(), found.end(), counts);
}

}  // namespace glue
