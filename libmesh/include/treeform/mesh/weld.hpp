#pragma once
/// \file
/// Merges points that are within a distance of each other: in clouds, meshes and whole files.
///
///     auto w = tf::weld(mesh, {.tolerance = 0.01});   // w.mesh, w.groups.group_of_point

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform {

/// A partition of points into groups, each of which becomes one point.
struct point_groups {
    /// [V] the group of each point; groups are numbered in the order of their first points
    std::vector<std::uint32_t> group_of_point{};
    /// [G] the first point of each group, ascending: the lowest-numbered, unless `order_by` is set
    std::vector<std::uint32_t> first_of_group{};
    treeform::status status = status::ok;  ///< or cancelled; then the rest is empty

    /// `mesh` with the points of each group joined: the first points of the groups, in order and
    /// unmoved, and all faces in order, also those that now repeat a corner.
    ///
    /// \throws std::invalid_argument for a mesh with another number of points; naming the lowest
    ///         face with a corner out of range
    /// \cost   O(V + F)
    [[nodiscard]] TREEFORM_API mesh joined(mesh_view mesh) const;
};

/// Finds the points whose coordinates are equal as doubles (-0 equals +0).
///
/// Distinct points are numbered in the order in which they first appear. Points that differ in one
/// bit stay distinct, however close they are (only -0 and +0 are equal). An infinity equals itself.
/// A point with a NaN coordinate equals no other, not even a copy of itself.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   O(V) expected time, also when all points are equal; about 12 bytes a point besides the
///         result's `first_of_group`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API point_groups find_equal_points(points_view points);

/// `mesh` with equal points joined. Points are in the order in which they first appear, with the
/// coordinates of the first, bit for bit. Nothing is dropped: faces keep their order, even those
/// that now repeat a corner, and points that no face uses stay.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points, or naming the lowest face with a
///         corner out of range
/// \cost   as `find_equal_points`, and O(F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh join_equal_points(mesh_view mesh);

/// Counts of what welding changed.
struct weld_statistics {
    std::uint64_t groups = 0;      ///< groups of two points or more
    std::uint64_t non_finite = 0;  ///< points with a NaN or infinite coordinate, left as they are
    std::uint64_t collapsed = 0;   ///< faces that repeat a corner only after the weld
    std::uint64_t degenerate = 0;  ///< faces that repeated a corner before
    /// The largest distance that a point moved, rounded up to a double.
    double max_displacement = 0.0;
    std::uint64_t nonmanifold_before = 0;  ///< edges of more than two faces
    std::uint64_t nonmanifold_after = 0;
    std::uint64_t flipped = 0;     ///< kept faces whose normal turned by more than a right angle
    std::uint64_t kept_apart = 0;  ///< groups that `keep_manifold` did not merge completely
};

/// The welded mesh.
struct weld_result {
    treeform::mesh mesh{};
    treeform::attributes
        attributes{};       ///< rows of "vertex", "face" and corners match points and faces
    point_groups groups{};  ///< of the input points; group numbers are points of `mesh`
    /// [G] the input point from which each point has its properties
    std::vector<std::uint32_t> vertex_source{};
    std::vector<std::uint32_t> face_source{};  ///< [F'] input face of each face
    weld_statistics statistics{};
    treeform::status status = status::ok;  ///< or cancelled; then the rest is empty
};

/// The welded file.
struct file_weld_result {
    mesh_file file{};       ///< like the input, with the kept points and faces
    point_groups groups{};  ///< of the input points; group numbers are points of `file`
    /// [G] the input point from which each point has its properties
    std::vector<std::uint32_t> vertex_source{};
    std::vector<std::uint32_t> face_source{};  ///< [F'] input triangle of each triangle
    weld_statistics statistics{};              ///< of triangles
    treeform::status status = status::ok;      ///< or cancelled; then the rest is empty

    /// Sets the flag "withheld" of LAS (a column of "vertex", added if missing) at the points of
    /// `input` that are not kept; other points keep their flag. `input` is the file that was
    /// welded.
    ///
    /// \throws std::invalid_argument if `input` has another number of points
    TREEFORM_API void withhold(mesh_file& input) const;
};

/// Merges the points of a mesh or point cloud that are within the tolerance of each other.
///
/// Distances are compared exactly, on the coordinates as given. Points are in the order of the
/// first points of their groups; faces keep their order. With `weld_keep::first`, kept points keep
/// their coordinates bit for bit. A point with a NaN or infinite coordinate is never merged, not
/// even with a copy of itself.
///
/// Faces that repeat a corner are dropped unless `keep_degenerate` is set: those that repeated it
/// before (`degenerate`) and those that do now (`collapsed`). So input faces = faces of the result
/// + collapsed + degenerate. Faces that became equal to others are kept. Edges are counted over
/// faces with three different corners.
///
/// With `keep` other than `first`, kept points may be within the tolerance of each other again, and
/// without `chain` a point may move by twice the tolerance.
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
/// nonmanifold before or faces collapse, the group is not merged. Points with equal coordinates are
/// merged first, and then the merged points. So coincident corners stay merged, even if the rest of
/// their group is not. In the result, an edge has more than two faces only if it had before, and a
/// point has several fans only if one of the points merged into it had. Points of one group may
/// stay within the tolerance of each other, and without `chain` a point may move by twice the
/// tolerance.
///
/// \throws std::invalid_argument for a tolerance that is negative or not finite; unless there is
///         one label for each point; for more than 2^32 - 2 points; for a corner out of range; for
///         a property that is missing or is a list (`weld_property_error`); for `order_by` with
///         another `keep` than `first`; for more than 2^32 / 3 faces with `keep_manifold`. The
///         message names the lowest invalid element
/// \cost   O(V log V + F log F) for any tolerance and any number of equal points, if `may_merge` is
///         empty or nearly always true. Parallel. Exception: without `chain`, points with several
///         others within the tolerance are processed serially if points are ordered row by row, or
///         if few are kept. Memory besides the result: up to 36 bytes a point (50 for dense
///         chains), 40 more with `order_by`; 24 bytes a face, 100 with `keep_manifold`; 8 bytes a
///         point for each property in a condition
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API weld_result weld(const mesh_ref& mesh, const weld_options& options = {});

/// The same with attributes, which stay with their points and faces. Corners keep their own texture
/// coordinates and normals, even if their points are merged. Rows of other elements are kept; point
/// numbers in integer columns named vertex1, vertex2, vertex_index and vertex_indices are updated.
/// Parts are kept, even if they have no face left.
///
/// \throws std::invalid_argument also unless there is one row for each point and each face, and
///         columns and corners have matching sizes
[[nodiscard]] TREEFORM_API weld_result weld(const mesh_ref& mesh, const attributes& properties,
                                            const weld_options& options);

/// `file` welded, with its attributes, parts and names. In a format that does not number its
/// vertices (STL), equal corners are merged first, unless `keep_manifold` is set or vertices have
/// properties. Polygons are welded as triangles, and stay polygons if their triangles are still one
/// fan.
[[nodiscard]] TREEFORM_API file_weld_result weld(const mesh_file& file,
                                                 const weld_options& options = {});

/// How many points of `welded`, a result of `weld` with `options`, would be merged if it were
/// written with precision `written_as`, read and welded again: rounding or `options.keep` can bring
/// points within the tolerance. None if points within the tolerance stay apart on purpose
/// (`only_borders`, `keep_manifold`), or if `progress` stopped the call.
[[nodiscard]] TREEFORM_API std::optional<std::uint64_t> count_mergeable(const mesh_file& welded,
                                                                        const weld_options& options,
                                                                        precision written_as);

/// Only the groups of points to merge, for callers who merge their own arrays. Uses only these
/// options: tolerance, chain, label, may_merge and progress.
///
/// \throws std::invalid_argument as `weld`
/// \cost   as `weld`
/// \same   as `weld`
[[nodiscard]] TREEFORM_API point_groups group_points(points_view points,
                                                     const weld_options& options = {});

/// The number of points that joining points within `distance` of each other would remove, beyond
/// those that joining equal points removes.
///
/// \cost as `group_points`
[[nodiscard]] TREEFORM_API std::uint64_t count_nearly_equal(points_view points, double distance);

}  // namespace treeform
