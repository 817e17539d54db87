#pragma once
/// \file
/// Nearest points, distances, inside and outside, rays, relation and depth of two meshes,
/// deviation.
///
/// Functions of many points or rays run in parallel, and write results to your arrays in the order
/// of the queries. An output array may be null.

#include <treeform/c/mesh.h>

// made of the headers of C++:
//   closest_point()
/// The points of the surface nearest to `queries` [count][3]: `faces` [count], `distances`
/// [count], `points` [count][3]. If none is within `radius` (may be infinite), these are
/// `TREEFORM_NONE`, infinite and NaN. Of several faces at the same distance, the lowest.
TREEFORM_C_API treeform_code treeform_closest_point(const treeform_mesh* mesh,
                                                    const double* queries, size_t count,
                                                    double radius, uint32_t* faces,
                                                    double* distances, double* points);
// end

/// The nearest points of two meshes.
typedef struct treeform_closest {
    uint32_t face_a;  ///< both `TREEFORM_NONE` if there are no such points
    uint32_t face_b;
    double distance;  ///< exactly 0 if and only if the meshes meet
    double on_a[3];
    double on_b[3];
} treeform_closest;

// made of the headers of C++:
//   closest_pair() distance() distance_poses() location locate() contains() winding_number()
//   locate_in_curves()
/// The nearest points of the surfaces `a` and `b`, each moved by a matrix (null: not moved), at
/// most `radius` apart.
TREEFORM_C_API treeform_code treeform_closest_pair(const treeform_mesh* a, const treeform_mesh* b,
                                                   const double* transform_a,
                                                   const double* transform_b, double radius,
                                                   treeform_closest* result);

/// The distance of the surfaces; infinite if one has no faces.
TREEFORM_C_API treeform_code treeform_distance(const treeform_mesh* a, const treeform_mesh* b,
                                               const double* transform_a, const double* transform_b,
                                               double* result);

/// The same for many positions, in parallel: `transforms_a` and `transforms_b` are [count][12], or
/// null if the mesh is not moved; `distances` [count] are infinite beyond `radius`. Surfaces
/// count; for solids, `treeform_check_poses`.
TREEFORM_C_API treeform_code treeform_distance_poses(const treeform_mesh* a, const treeform_mesh* b,
                                                     const double* transforms_a,
                                                     const double* transforms_b, size_t count,
                                                     double radius, double* distances);

/// The position of a point relative to a surface or curve.
typedef int32_t treeform_location;
enum { TREEFORM_OUTSIDE = 0, TREEFORM_INSIDE = 1, TREEFORM_BOUNDARY = 2 };
/// The name of a value, as in reports: "outside"; "unknown" for others.
TREEFORM_C_API const char* treeform_location_name(treeform_location value);

/// The positions of `points` [count][3] relative to a closed mesh, exactly. `where` [count] is a
/// `treeform_location` for each; `winding` [count] how often the surface winds around the point;
/// `on` [count] the lowest face that contains a point on the boundary, else `TREEFORM_NONE`.
/// Returns `TREEFORM_INVALID`, naming an edge, if the mesh is open.
TREEFORM_C_API treeform_code treeform_locate(const treeform_mesh* mesh, const double* points,
                                             size_t count, uint8_t* where, int32_t* winding,
                                             uint32_t* on);

/// `inside` [count]: 1 for points inside the closed mesh or on its surface, else 0.
TREEFORM_C_API treeform_code treeform_contains(const treeform_mesh* mesh, const double* points,
                                               size_t count, uint8_t* inside);

/// `winding` [count]: how often the surface winds around each point; 0 on the surface.
TREEFORM_C_API treeform_code treeform_winding_number(const treeform_mesh* mesh,
                                                     const double* points, size_t count,
                                                     int32_t* winding);

/// Like `treeform_locate`, for closed curves in the plane: `points` [point_count][2], `edges`
/// [edge_count][2] by point numbers, with the inside on their left; `queries` [count][2].
TREEFORM_C_API treeform_code treeform_locate_in_curves(const double* points, size_t point_count,
                                                       const uint32_t* edges, size_t edge_count,
                                                       const double* queries, size_t count,
                                                       uint8_t* where, int32_t* winding);
// end

/// A ray: the points origin + t direction for t_min <= t <= t_max.
typedef struct treeform_ray {
    double origin[3];
    double direction[3];
    double t_min;
    double t_max;
} treeform_ray;

// made of the headers of C++:
//   triangle_feature mesh_hit raycast() raycast_any()
/// A part of a triangle. Edge `TREEFORM_AT_E0` runs from v0 to v1, `TREEFORM_AT_E1` from v1 to v2,
/// `TREEFORM_AT_E2` from v2 to v0; `TREEFORM_AT_INTERIOR` is the triangle without its edges.
typedef int32_t treeform_triangle_feature;
enum {
    TREEFORM_AT_V0 = 0,
    TREEFORM_AT_V1 = 1,
    TREEFORM_AT_V2 = 2,
    TREEFORM_AT_E0 = 3,
    TREEFORM_AT_E1 = 4,
    TREEFORM_AT_E2 = 5,
    TREEFORM_AT_INTERIOR = 6
};

/// A face that a ray hits. The point hit is origin + t direction.
typedef struct treeform_mesh_hit {
    uint32_t face;
    /// corner, edge or interior that contains the first common point (a
    /// `treeform_triangle_feature`)
    uint8_t at;
    uint8_t coplanar;  ///< the ray runs in the face's plane, or the face has no area
    double t;          ///< of the first common point; relative error below 2^-40
    double t_end;      ///< of the last common point; equal to t unless coplanar
} treeform_mesh_hit;

/// `hits` [count]: the first face that each ray hits, exactly; of several faces at the same point,
/// the lowest. For a ray that hits none, `face` is `TREEFORM_NONE`, `t` and `t_end` are NaN.
TREEFORM_C_API treeform_code treeform_raycast(const treeform_mesh* mesh, const treeform_ray* rays,
                                              size_t count, treeform_mesh_hit* hits);

/// `hit` [count]: 1 if the ray hits any face, else 0.
TREEFORM_C_API treeform_code treeform_raycast_any(const treeform_mesh* mesh,
                                                  const treeform_ray* rays, size_t count,
                                                  uint8_t* hit);
// end

/// All hits of many rays: those of ray i are hits[begin[i]] ... hits[begin[i + 1] - 1].
typedef struct treeform_hits {
    void* owner;
    const size_t* begin;  ///< [count + 1]
    const treeform_mesh_hit* hits;
    size_t count;  ///< rays
} treeform_hits;

// made of the headers of C++:
//   raycast_all() mesh_relation relation_result measure_options measure() relation()
//   penetration_depth() count_inside_out() count_sides() deviation_options deviation_result
//   deviation()
/// All faces that each ray hits, in the exact order along the ray, then by number.
TREEFORM_C_API treeform_code treeform_raycast_all(const treeform_mesh* mesh,
                                                  const treeform_ray* rays, size_t count,
                                                  treeform_hits** hits);

/// The relation of two meshes; see `treeform_relation`. The last two occur only with a clearance.
typedef int32_t treeform_mesh_relation;
enum {
    TREEFORM_RELATION_DISJOINT = 0,
    TREEFORM_RELATION_TOUCHING = 1,
    TREEFORM_RELATION_PENETRATING = 2,
    TREEFORM_RELATION_CLOSER_THAN_CLEARANCE = 3,
    /// disjoint, by at least the clearance
    TREEFORM_RELATION_CLEAR = 4
};
/// The name of a value, as in reports: "disjoint"; "unknown" for others.
TREEFORM_C_API const char* treeform_mesh_relation_name(treeform_mesh_relation value);

/// The relation and distance of two meshes.
typedef struct treeform_relation_result {
    void* owner;
    treeform_mesh_relation relation;
    /// Faces that prove the relation: two that cross, overlap with the inside on the same side, or
    /// touch. For a mesh that is entirely or partly inside the other, its lowest face there. Both
    /// are 0 if the meshes are disjoint.
    uint32_t face_a;
    uint32_t face_b;
    /// a component of `a` is inside the solid `b` without touching it
    int32_t a_inside_b;
    int32_t b_inside_a;  ///< the same with `a` and `b` exchanged
    /// Not squared. 0 if and only if the meshes touch or penetrate each other.
    double distance;
    /// Exactly 0 if and only if a face of one meets a face of the other. So it is positive for a
    /// mesh inside a solid whose surface it does not touch.
    double surface_distance;
    uint32_t nearest_a;       ///< the face of `a` that contains `on_a`
    uint32_t nearest_b;       ///< the face of `b` that contains `on_b`
    double on_a[3];           ///< the nearest point on the surface of `a`
    double on_b[3];           ///< the nearest point on the surface of `b`
    double barycentric_a[3];  ///< barycentric coordinates of `on_a` in that face
    double barycentric_b[3];  ///< barycentric coordinates of `on_b` in that face
} treeform_relation_result;

/// Options of `treeform_relation`, `treeform_measure` and `treeform_penetration_depth`. Each
/// ignores those that do not concern it.
typedef struct treeform_measure_options {
    size_t struct_size;
    /// For `treeform_measure`: ignore meshes farther apart than this; inclusive, not squared;
    /// default infinite
    double radius;
    /// Only closed meshes have an inside; this decides whether a mesh is closed.
    treeform_vertex_identity vertices;
    treeform_progress progress;
    void* progress_data;
    /// For `treeform_penetration_depth`: number of directions, spread over the sphere, to try
    /// besides the normals of faces that meet; default 256
    uint64_t directions;
    /// For `treeform_penetration_depth`: largest number of pairs of faces to test; a pair in
    /// motion counts as two. 0: 20 million plus 200 for each face.
    uint64_t effort;
} treeform_measure_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_measure_options_init(treeform_measure_options* options, size_t size);

/// The relation of `a` and `b`, their distance and their nearest points. Null, with `TREEFORM_OK`,
/// if one is empty, or if they are disjoint and further apart than `options->radius`.
///
/// The relation is exact (see `treeform_relation`), and so is whether a distance is 0. Other
/// distances are rounded as in `treeform_distance`. If the two faces named by `treeform_relation`
/// meet, the points are on them.
TREEFORM_C_API treeform_code treeform_measure(const treeform_mesh* a, const treeform_mesh* b,
                                              const treeform_measure_options* options,
                                              treeform_relation_result** result);

/// Only the relation, exactly: disjoint, touching or penetrating.
TREEFORM_C_API treeform_code treeform_relation(const treeform_mesh* a, const treeform_mesh* b,
                                               treeform_vertex_identity vertices,
                                               treeform_mesh_relation* result);

/// `depth` is the length of a short translation `move` that separates `a` from `b`, verified
/// exactly: an upper bound of the penetration depth. Both are 0 if the meshes do not penetrate
/// each other. `effort` is the effort of the search; may be null.
TREEFORM_C_API treeform_code treeform_penetration_depth(const treeform_mesh* a,
                                                        const treeform_mesh* b,
                                                        const treeform_measure_options* options,
                                                        double* depth, double move[3],
                                                        treeform_search_effort* effort);

/// The number of components of a closed mesh that are inside out (of negative volume) without
/// being cavities, that is, inside no other component. Components are faces linked by edges, with
/// corners of equal coordinates joined. 0 for an open mesh and for a cloud. `treeform_relation`,
/// `treeform_clash` and `treeform_locate` treat such a component as the solid that it bounds;
/// `treeform_repair` flips it.
TREEFORM_C_API treeform_code treeform_count_inside_out(const treeform_mesh* mesh, uint64_t* result);

/// Counts `points` [points_count][3] by their position relative to `solids` [solids_count],
/// exactly: counts[0] is the number of points strictly inside at least one solid, counts[1] that
/// of other points on a surface, counts[2] that of points outside all solids.
TREEFORM_C_API treeform_code treeform_count_sides(const double* points, size_t points_count,
                                                  const treeform_mesh* const* solids,
                                                  size_t solids_count, uint64_t counts[3]);

/// What to compute besides distances.
typedef struct treeform_deviation_options {
    size_t struct_size;
    /// lower end of the tolerance band of signed distances; NaN: no band
    double band_low;
    double band_high;  ///< its upper end
    uint64_t bins;     ///< number of intervals of the histogram; 0: none; default 40
    /// also compute distances of the points of `b` from `a`; default 1
    int32_t both_ways;
    treeform_progress progress;
    void* progress_data;
} treeform_deviation_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_deviation_options_init(treeform_deviation_options* options,
                                                    size_t size);

/// Distances of points from a surface, and their statistics.
typedef struct treeform_deviation_result {
    void* owner;
    /// [V] of `a`: the distance of each point from the surface of `b`, negative inside the solid
    /// that `b` bounds, exactly 0 on its surface. Never negative if `b` bounds no solid.
    const double* distances;
    const uint32_t* faces;  ///< [V] the nearest face of `b`
    size_t count;
    int32_t is_signed;     ///< Whether `b` is closed, so that distances have a sign.
    double mean;           ///< mean of the signed distances
    double mean_absolute;  ///< mean of their magnitudes
    double rms;            ///< root mean square of the distances
    /// Median of the magnitudes: the least value that half of them do not exceed.
    double p50;
    double p95;      ///< the same for 95% of them
    double p99;      ///< the same for 99% of them
    double max;      ///< the largest magnitude
    uint32_t worst;  ///< the lowest point number with that magnitude
    double lowest;   ///< the least signed distance
    double highest;  ///< the greatest signed distance
    /// Bound of the distance from any point of the surface `a` to `b`: the maximum, over its
    /// faces, of the largest corner distance plus the longest edge / sqrt(3). For a cloud it is
    /// `max`, rounded up.
    double max_bound;
    /// With `both_ways`, a bound of the distance from any point of the surface `b` to `a`. The
    /// larger of this and `max_bound` bounds the Hausdorff distance of the surfaces; NaN: none
    double reverse_max_bound;
    /// [bins] points by signed distance, in intervals of equal length from `lowest` to `highest`;
    /// the last one includes `highest`.
    const uint64_t* histogram;
    size_t bins;
    /// If distances have a sign: points of `a` inside, on and outside of `b`.
    uint64_t side_counts[3];
    /// With `both_ways`, the largest distance of a vertex of `b` from `a`. The larger of this and
    /// `max` is the Hausdorff distance of the points; NaN: none
    double reverse_max;
    /// With a band: points below, within and above it. Both ends are within.
    uint64_t band_counts[3];
} treeform_deviation_result;

/// The signed distances of all points of `a`, used by faces or not, from the surface of `b`.
/// Several meshes `b` count as one, with faces numbered mesh after mesh.
///
/// The sign is exact: that of the winding number of `b` around the point (`treeform_locate`).
/// Corners of `b` with equal coordinates are one vertex. If `b` is open, or a cloud, it has no
/// inside, and distances have no sign. Magnitudes have the error bound of
/// `treeform_closest_point`; a distance may round to 0.
///
/// Null, with `TREEFORM_OK`, if `a` or `b` is empty.
TREEFORM_C_API treeform_code treeform_deviation(const treeform_mesh* a,
                                                const treeform_mesh* const* b, size_t count,
                                                const treeform_deviation_options* options,
                                                treeform_deviation_result** result);
// end
