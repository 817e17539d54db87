#pragma once
/// \file
/// The vertices of a mesh, or the points of a cloud with their properties, welded: what is kept of
/// each group, what must agree, and what becomes of the faces.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld_points.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace treeform {

/// A vertex property that must agree for two points to be put together.
struct weld_condition {
    /// A column of the element "vertex" with one value a row, or "x", "y", "z" for the coordinates.
    std::string property{};
    /// Largest difference of two values, inclusive and decided exactly. NaN agrees with NaN alone,
    /// an infinity with itself, -0 with +0.
    double tolerance = 0.0;
};

/// Which point of a group gives its place and its properties to what is kept.
enum class weld_keep : std::uint8_t {
    first,   ///< the lowest-numbered; nothing that is kept moves
    last,    ///< the highest-numbered
    mean,    ///< the mean of the places and of floating-point properties; the rest is the first's
    lowest,  ///< the one with the least value of `keep_by`, never NaN if there are others; of equal
             ///< ones the first
    highest  ///< the one with the greatest, likewise
};

struct mesh_weld_options {
    weld_options points{};  ///< `kind` and `agree` come on top of `conditions`
    std::vector<weld_condition> conditions{};
    weld_keep keep = weld_keep::first;
    std::string keep_by{};  ///< for `lowest` and `highest`: a property as in `weld_condition`
    bool only_borders =
        false;  ///< only points on edges of exactly one face; others stay as they are
    /// Split groups so that no edge of more than two faces and no point where several fans of faces
    /// meet comes about; see `weld_mesh`.
    bool keep_manifold = false;
    bool keep_collapsed = false;  ///< keep faces that repeat a corner
};

struct mesh_weld_result {
    treeform::mesh mesh{};
    treeform::attributes
        attributes{};       ///< rows of "vertex", "face" and corners follow points and faces
    point_groups groups{};  ///< of the points given; group numbers are points of `mesh`
    std::vector<std::uint32_t> point_of_group{};  ///< [G] the point that gave its properties
    std::vector<std::uint32_t> face_of_new{};     ///< [F'] the face given that each face was
    std::uint64_t collapsed = 0;   ///< faces that repeat a corner, but did not before
    std::uint64_t degenerate = 0;  ///< faces that repeated a corner before
    /// Greatest distance of a point from where it ended up: the least double that is no less.
    double largest_move = 0.0;
    std::uint64_t nonmanifold_before = 0;  ///< edges of more than two faces
    std::uint64_t nonmanifold_after = 0;
    std::uint64_t flipped = 0;     ///< kept faces whose normal turned by more than a right angle
    std::uint64_t left_alone = 0;  ///< groups that `keep_manifold` did not put together whole
};

/// Welds the points of `mesh`. Points keep the order of the groups' first points, faces theirs;
/// a mesh without faces is a cloud. With tolerance 0 and `weld_keep::first` the result has the
/// coordinates given, bit for bit, and so has it with any tolerance for points that are kept.
///
/// Faces that repeat a corner are dropped unless `keep_collapsed` is set, the `collapsed` ones and
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
/// Corners keep the texture coordinates and normals of their own, also where their points become
/// one. The rows of other elements are kept; those of integer columns named vertex1, vertex2,
/// vertex_index and vertex_indices that number a point are renumbered. Parts keep their faces, also
/// when none is left. When `options.points.progress` stops the search, `groups.stopped` is set and
/// the rest is empty.
///
/// \throws std::invalid_argument as `weld_points`, for a corner that is no point, a property that
///         is not there or is a list, a tolerance of a condition that is negative or not finite,
///         rows that are not one a point and one a face, columns and corners that do not fit, or
///         more than 2^32 / 3 faces with `keep_manifold`
/// \cost   as `weld_points`, and O(F log F); about 24 bytes a face and 8 a point besides
///         the result, 100 a face with `keep_manifold`, 8 a point and property for conditions
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_weld_result weld_mesh(mesh_view mesh, const attributes& properties,
                                                      const mesh_weld_options& options);

/// The conditions that keep seams: equality of each of the usual columns of normals (nx, ny, nz),
/// texture coordinates (u, v, s, t, texture_u, texture_v) and colours (red, green, blue, alpha)
/// that "vertex" has, in the order of the columns; empty when there is none.
[[nodiscard]] TREEFORM_API std::vector<weld_condition> seam_conditions(
    const attributes& properties);

}  // namespace treeform
