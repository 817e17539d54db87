#pragma once
/// \file
/// Merges points within a distance of each other: in clouds, meshes and files.

#include <treeform/c/files.h>

// made of the headers of C++:
//   weld_keep weld_condition weld_options weld_result weld() weld_file() group_points()
//   count_nearly_equal() count_mergeable() withhold()
/// Which point of a group is kept, with its coordinates and properties.
typedef int32_t treeform_weld_keep;
enum {
    /// the lowest-numbered; kept points do not move
    TREEFORM_KEEP_FIRST = 0,
    /// the highest-numbered
    TREEFORM_KEEP_LAST = 1,
    /// the mean of coordinates and floating-point properties; the rest: the first point's
    TREEFORM_KEEP_MEAN = 2,
    /// the one with the least value of `keep_by`, not NaN if there are others; of equal ones the
    /// first
    TREEFORM_KEEP_LOWEST = 3,
    /// the one with the greatest value of `keep_by`, otherwise as `TREEFORM_KEEP_LOWEST`
    TREEFORM_KEEP_HIGHEST = 4
};

/// A vertex property that must agree for two points to be merged.
typedef struct treeform_weld_condition {
    /// A column of the element "vertex" with one value a row; "x", "y" or "z" for a coordinate;
    /// "normal", "uv" or "color" for all columns of that kind.
    const char* property;
    /// Largest difference of two values, inclusive and decided exactly. NaN agrees only with NaN,
    /// an infinity only with itself, -0 with +0.
    double tolerance;
} treeform_weld_condition;

/// How to weld. Most callers only set `tolerance`.
typedef struct treeform_weld_options {
    size_t struct_size;
    double tolerance;  ///< Euclidean, inclusive; 0: equal coordinates (-0 equals +0)
    /// The rule that forms groups. By default, points are visited in order, and one is dropped if
    /// an earlier kept point is within the tolerance. The dropped point joins the nearest of these
    /// kept points, and the earliest of equally near ones. So no two kept points are within the
    /// tolerance, no point is further than the tolerance from the kept point of its group, and
    /// welding the kept points again changes nothing. With `chain`, all points linked by steps of
    /// at most the tolerance are one group. Its earliest point is kept. A point may be many
    /// tolerances away from that point.
    int32_t chain;
    /// [V] or empty: points with different labels are never merged; or null
    const uint32_t* label;
    size_t label_count;
    /// whether two points may be merged; or null. Symmetric; called from several threads at once
    int (*may_merge)(uint32_t a, uint32_t b, void* data);
    void* may_merge_data;
    /// [same_count] Properties that must agree, in addition to `label` and `may_merge`.
    const treeform_weld_condition* same;
    size_t same_count;
    /// For a mesh with faces: keep seams, that is, normals, texture coordinates and colors of
    /// points must agree, except for those named in `ignored_seams`.
    int32_t keep_seams;
    const char* const* ignored_seams;  ///< [ignored_seam_count]
    size_t ignored_seam_count;
    treeform_weld_keep keep;
    /// for `TREEFORM_KEEP_LOWEST` and `TREEFORM_KEEP_HIGHEST`: a property as in
    /// `treeform_weld_condition`
    const char* keep_by;
    /// A property as in `treeform_weld_condition`. Points are visited in the order of its values:
    /// the smallest first, NaN last, equal values by point number. The point of a group that is
    /// visited first is kept. Needs `TREEFORM_KEEP_FIRST`. Empty: by point number. Kept points
    /// remain in the order of their numbers.
    const char* order_by;
    int32_t highest_first;  ///< for `order_by`: the greatest value first
    int32_t only_borders;   ///< merge only points on edges of exactly one face
    /// split groups that would make non-manifold edges or points
    int32_t keep_manifold;
    int32_t keep_degenerate;  ///< keep faces that repeat a corner
    treeform_progress progress;
    void* progress_data;
} treeform_weld_options;
/// Sets the defaults.
TREEFORM_C_API void treeform_weld_options_init(treeform_weld_options* options, size_t size);

/// The welded mesh.
typedef struct treeform_weld_result {
    void* owner;
    treeform_arrays mesh;
    /// [V] the group of each point; groups are numbered in the order of their first points
    const uint32_t* group_of_point;
    size_t point_count;
    /// [G] the first point of each group, ascending: the lowest-numbered, unless `order_by` is set
    const uint32_t* first_of_group;
    /// [G] the input point from which each point has its properties
    const uint32_t* vertex_source;
    size_t group_count;
    const uint32_t* face_source;  ///< [F'] input face of each face
    uint64_t merged_groups;       ///< groups of two points or more
    /// points with a NaN or infinite coordinate, left as they are
    uint64_t non_finite;
    uint64_t collapsed;   ///< faces that repeat a corner only after the weld
    uint64_t degenerate;  ///< faces that repeated a corner before
    /// The largest distance that a point moved, rounded up to a double.
    double max_displacement;
    uint64_t nonmanifold_before;  ///< edges of more than two faces
    uint64_t nonmanifold_after;
    uint64_t flipped;     ///< kept faces whose normal turned by more than a right angle
    uint64_t kept_apart;  ///< groups that `keep_manifold` did not merge completely
    /// for a file: the result with its attributes; else null
    const treeform_file* file;
} treeform_weld_result;

/// Merges the points of a mesh or point cloud that are within the tolerance of each other.
///
/// Distances are compared exactly, on the coordinates as given. Points are in the order of the
/// first points of their groups; faces keep their order. With `TREEFORM_KEEP_FIRST`, kept points
/// keep their coordinates bit for bit. A point with a NaN or infinite coordinate is never merged,
/// not even with a copy of itself.
///
/// Faces that repeat a corner are dropped unless `keep_degenerate` is set: those that repeated it
/// before (`degenerate`) and those that do now (`collapsed`). So input faces = faces of the result
/// + collapsed + degenerate. Faces that became equal to others are kept. Edges are counted over
/// faces with three different corners.
///
/// With `keep` other than `TREEFORM_KEEP_FIRST`, kept points may be within the tolerance of each
/// other again, and without `chain` a point may move by twice the tolerance.
///
/// A mean is the first point's value plus the mean of the differences from it, added in the order
/// of points and rounded at each step. For n values that differ by at most d, its error is at most
/// n d 2^-52 plus one unit in the last place. It is between the least and the greatest value;
/// float32 columns are rounded once more. Averaged normals are not scaled to length 1. A mean with
/// a NaN or an infinity is NaN.
///
/// With `keep_manifold`, points of a group are merged only where two edges become one edge of at
/// most two faces, or where an edge shrinks to a point. All points of a group that are linked in
/// this way become one point, with a first, last or mean of its own; the other points of the group
/// stay separate. Points without faces join the lowest such set of points with faces. So a surface
/// that was cut open closes along its seams, while solids that meet in an edge or a corner stay
/// apart. If merging a group would still make an edge or a point nonmanifold, because a point was
/// nonmanifold before or faces collapse, the group is not merged. Points with equal coordinates
/// are merged first, and then the merged points. So coincident corners stay merged, even if the
/// rest of their group is not. In the result, an edge has more than two faces only if it had
/// before, and a point has several fans only if one of the points merged into it had. Points of
/// one group may stay within the tolerance of each other, and without `chain` a point may move by
/// twice the tolerance.
TREEFORM_C_API treeform_code treeform_weld(const treeform_mesh* mesh,
                                           const treeform_weld_options* options,
                                           treeform_weld_result** result);

/// Welds a file, with its attributes, parts and names.
TREEFORM_C_API treeform_code treeform_weld_file(const treeform_file* file,
                                                const treeform_weld_options* options,
                                                treeform_weld_result** result);

/// Only the groups of the points of a mesh or cloud; `mesh` of the result is empty.
TREEFORM_C_API treeform_code treeform_group_points(const treeform_mesh* mesh,
                                                   const treeform_weld_options* options,
                                                   treeform_weld_result** result);

/// The number of points that joining points within `distance` of each other would remove, beyond
/// those that joining equal points removes.
TREEFORM_C_API treeform_code treeform_count_nearly_equal(const treeform_mesh* mesh, double distance,
                                                         uint64_t* result);

/// How many points of a welded file would be merged if it were written with this precision, read
/// and welded again; `known` is 0 if options keep points apart on purpose.
TREEFORM_C_API treeform_code treeform_count_mergeable(const treeform_file* welded,
                                                      const treeform_weld_options* options,
                                                      treeform_precision written_as,
                                                      uint64_t* count, int32_t* known);

/// Sets the flag "withheld" of LAS at the points of `file` that its weld result `welded` does not
/// keep.
TREEFORM_C_API treeform_code treeform_withhold(treeform_file* file,
                                               const treeform_weld_result* welded);
// end
