#pragma once
/// \file
/// Points within a distance of each other become one: in clouds, in meshes, in whole files.
///
///     auto w = tf::weld(mesh, {.tolerance = 0.01});   // w.mesh, w.groups.group_of_point

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/weld_options.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform {

/// Which points become one.
struct point_groups {
    std::vector<std::uint32_t> group_of_point{};  ///< [V] groups are numbered by their first points
    std::vector<std::uint32_t>
        first_of_group{};                  ///< [G] the lowest-numbered point of each, ascending
    treeform::status status = status::ok;  ///< or cancelled; then the rest is empty
};

/// What welding has done to points and faces.
struct weld_statistics {
    std::uint64_t groups = 0;      ///< of two points or more
    std::uint64_t non_finite = 0;  ///< points with a NaN or infinite coordinate, left as they are
    std::uint64_t collapsed = 0;   ///< faces that repeat a corner, but did not before
    std::uint64_t degenerate = 0;  ///< faces that repeated a corner before
    /// Greatest distance of a point from where it ended up: the least double that is no less.
    double max_displacement = 0.0;
    std::uint64_t nonmanifold_before = 0;  ///< edges of more than two faces
    std::uint64_t nonmanifold_after = 0;
    std::uint64_t flipped = 0;     ///< kept faces whose normal turned by more than a right angle
    std::uint64_t left_alone = 0;  ///< groups that `keep_manifold` did not join whole
};

struct weld_result {
    treeform::mesh mesh{};
    treeform::attributes
        attributes{};       ///< rows of "vertex", "face" and corners follow points and faces
    point_groups groups{};  ///< of the points given; group numbers are points of `mesh`
    std::vector<std::uint32_t> point_of_group{};  ///< [G] the point that gave its properties
    std::vector<std::uint32_t> face_of_new{};     ///< [F'] the face given that each face was
    weld_statistics statistics{};
    treeform::status status = status::ok;  ///< or cancelled; then the rest is empty
};

struct cloud_weld_result {
    std::vector<point3> points{};                 ///< [G]
    treeform::attributes attributes{};            ///< rows of "vertex" follow the points
    point_groups groups{};                        ///< of the points given
    std::vector<std::uint32_t> point_of_group{};  ///< [G] the point that gave its properties
    weld_statistics statistics{};                 ///< of faces there are none
    treeform::status status = status::ok;         ///< or cancelled; then the rest is empty
};

struct file_weld_result {
    mesh_file file{};       ///< as the one given, with the points and faces that are kept
    point_groups groups{};  ///< of the points given; group numbers are points of `file`
    std::vector<std::uint32_t> point_of_group{};  ///< [G] the point that gave its properties
    std::vector<std::uint32_t> face_of_new{};  ///< [F'] the triangle given that each triangle was
    weld_statistics statistics{};              ///< of triangles
    treeform::status status = status::ok;      ///< or cancelled; then the rest is empty
};

/// `mesh` with the points within the tolerance of each other joined. Points keep the order of the
/// groups' first points, faces theirs. With tolerance 0 and `weld_keep::first` the result has the
/// coordinates given, bit for bit, and so has it with any tolerance for points that are kept.
/// Whether two points are within the tolerance is decided exactly on the coordinates as given, and
/// so is which of two is nearer. Points with a NaN or infinite coordinate stay alone, also from
/// their like.
///
/// Faces that repeat a corner are dropped unless `keep_degenerate` is set, the `collapsed` ones and
/// the `degenerate` alike: without it, faces given = faces of the result + collapsed + degenerate.
/// Faces that have become equal to others stay. Edges are counted over faces with three corners.
///
/// With `keep` other than `first`, kept points may be within the tolerance of each other again, and
/// with the rule `first` a point may move by twice the tolerance.
/// Means are sums of differences from the first point's value in the order of points, rounded at
/// each step (for n values that differ by at most d, off by no more than n d 2^-52 and a last
/// place), and lie between the least and the greatest value; float32 columns round once more.
/// Averaged normals are not made unit vectors again. A property with a NaN or an
/// infinity among several is NaN.
///
/// `keep_manifold` joins points of a group only along edges: those of two faces that the groups
/// make one edge of at most two faces, and edges that shrink to a point. What hangs together so
/// becomes one point; others of the group are points of their own, each part with its own first,
/// last or mean, and points that no face uses go with the lowest part that has faces. So the seams
/// of a surface cut open close as one, and solids that meet in an edge or a corner come apart.
/// Where a group would still do harm, because points were not manifold before or faces shrink, it
/// is left as single points; this is done to points with equal coordinates first, and then to what
/// they became, so that coinciding corners stay joined where the rest of a group does not. Every
/// edge of more than two faces in the result was one before, every point of several fans has such a
/// point in it. Points of one group may thus stay within the tolerance of each other, and with the
/// rule `first` a point may move by twice the tolerance.
///
/// \throws std::invalid_argument for a tolerance that is negative or not finite, labels that are
///         not one a point, more than 2^32 - 2 points, a corner out of range, a property that
///         is not there or is a list (`weld_property_error`), or more than 2^32 / 3 faces with
///         `keep_manifold`; all name the lowest element of the arrays given
/// \cost   O(V log V + F log F) for any tolerance and any number of equal points, as long as
///         `may_merge` is empty or nearly always true; parallel, except for rule `first` where most
///         points have several others within the tolerance. Groups take up to 36 bytes a point (50
///         for chains in dense places, 110 by `tree`); faces 24 each besides the result, 100 with
///         `keep_manifold`; conditions 8 a point and property
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API weld_result weld(mesh_view mesh, const weld_options& options = {});
[[nodiscard]] TREEFORM_API weld_result weld(const prepared_mesh& mesh,
                                            const weld_options& options = {});

/// The same, and `properties` follow. Corners keep the texture coordinates and normals of their
/// own, also where their points become one. The rows of other elements are kept; those of integer
/// columns named vertex1, vertex2, vertex_index and vertex_indices that number a point are
/// renumbered. Parts keep their faces, also when none is left.
///
/// \throws std::invalid_argument also for rows that are not one a point and one a face, and columns
///         and corners that do not fit
[[nodiscard]] TREEFORM_API weld_result weld(mesh_view mesh, const attributes& properties,
                                            const weld_options& options);

/// `points` with those within the tolerance of each other joined; in all else as a mesh without
/// faces.
[[nodiscard]] TREEFORM_API cloud_weld_result weld(points_view points,
                                                  const weld_options& options = {});
[[nodiscard]] TREEFORM_API cloud_weld_result weld(points_view points, const attributes& properties,
                                                  const weld_options& options);

/// `file` welded, with all that belongs to it. Corners of a format that does not number its
/// vertices (STL) are joined where they are equal before anything else is asked, unless
/// `keep_manifold` is set or vertices have properties. Polygons are welded as triangles, and are
/// polygons again where their triangles are still one fan.
[[nodiscard]] TREEFORM_API file_weld_result weld(const mesh_file& file,
                                                 const weld_options& options = {});

/// How many points of `welded`, which `weld` has made with `options`, would become one with another
/// if it were written with coordinates of `written_as`, read, and welded again: those that rounding
/// or the choice of what is kept has brought together. None where points within the tolerance are
/// left apart on purpose (`only_borders`, `keep_manifold`), or where progress said stop.
[[nodiscard]] TREEFORM_API std::optional<std::uint64_t> count_still_within(
    const mesh_file& welded, const weld_options& options, precision written_as);

/// The groups alone, for callers with arrays of their own. Of `options` those matter that say which
/// points become one: tolerance, rule, search, label, may_merge and progress.
///
/// \throws std::invalid_argument as `weld`
/// \cost   as `weld`
/// \same   as `weld`
[[nodiscard]] TREEFORM_API point_groups group_points(points_view points,
                                                     const weld_options& options = {});

/// How many points would not be there any more if points within `distance` of each other were
/// joined, beyond those that are equal to another.
///
/// \cost as `group_points`
[[nodiscard]] TREEFORM_API std::uint64_t count_nearly_equal(points_view points, double distance);

/// `mesh` with the points of each group joined: the groups' first points in order and unmoved,
/// faces in order, also those that now repeat a corner. Nothing else is dropped.
///
/// \throws std::invalid_argument for groups of another number of points, or naming the lowest face
///         with a corner out of range
/// \cost   O(V + F)
[[nodiscard]] TREEFORM_API mesh join_groups(mesh_view mesh, const point_groups& groups);

}  // namespace treeform
