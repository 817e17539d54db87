#pragma once
/// \file
/// Intersections of two meshes, and of a mesh with a box. Intersection curves, as segments or
/// joined into paths whose points are named by edges and faces. Writing curves to files.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

/// All pairs of a face of `a` and a face of `b` that have a common point.
///
/// Exact on the coordinates as given, or as moved. The kinds are crossing, overlap, touching and
/// degenerate: two meshes share no corners, so faces that meet in equal corners are `touching`, and
/// equal faces `overlap`. Surfaces count, not solids: a mesh inside the other that does not touch
/// it gives no pair. `a` and `b` may be the same mesh. For meshes that are not prepared, only the
/// faces that reach into the intersection of both bounding boxes (after the transforms) are
/// indexed.
///
/// \throws std::invalid_argument if a transform is not finite; naming the mesh and its face with a
///         corner that is out of range or, after the transform, not finite
/// \cost   O(F log F) for indexes that are not built yet; O(B) time for the B pairs whose boxes
///         overlap and the nodes above them. Up to twice as fast for prepared meshes
/// \same   on any number of threads
/// \source candidate pairs: Sajovic, Knez and Korez, tf::tree, section III-C
[[nodiscard]] TREEFORM_API face_pair_result
mesh_intersections(const mesh_ref& a, const mesh_ref& b, const face_pair_options& options = {});

/// Whether a face of `a` and a face of `b` have a common point; touching counts. Exact. Returns as
/// soon as one pair is found. For meshes that are not prepared, only the faces that reach into the
/// intersection of both bounding boxes (after the transforms) are indexed.
///
/// \throws std::invalid_argument as `mesh_intersections`
/// \same   in its answer, on any number of threads
[[nodiscard]] TREEFORM_API bool intersects(const mesh_ref& a, const mesh_ref& b,
                                           const mesh_pair_options& positions = {});

/// The faces, ascending, that have a point in the closed box from `min` to `max`.
///
/// Exact: faces are tested, not their boxes. A face that only touches the box is included. The box
/// may be flat, a line or a point.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument when a coordinate of the box is not finite or min exceeds max, or
///         naming the lowest face with a corner out of range
/// \cost   O(F) time
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> faces_in_box(const mesh_ref& mesh,
                                                                   const point3& min,
                                                                   const point3& max);

/// [pairs] The intersection of each pair as segments, by their ends: one segment for a crossing,
/// the 3 to 6 sides of the common area for faces that overlap, a segment of length 0 for a single
/// point, none for faces that do not meet.
///
/// Whether there is a segment is exact. Its ends are rounded, and finite.
///
/// \throws std::invalid_argument naming the pair with a face or a corner that is out of range or
///         not finite
/// \cost O(pairs)
/// \same on any number of threads
[[nodiscard]] TREEFORM_API answer_lists<std::array<point3, 2>> intersection_curves(
    mesh_view mesh, std::span<const face_pair> pairs);

/// A point of a curve, named by the lowest-numbered vertex, edges or face that meet there:
/// - a vertex: `edge` and `by` both have its number twice;
/// - two edges that cross: `edge` and `by`, each as its two point numbers, ascending;
/// - an edge that meets the inside of a face: `edge`, and the face as `by[0]`; `by[1]` is `none`.
struct curve_point {
    static constexpr std::uint32_t none = operand_element::none;

    std::array<std::uint32_t, 2> edge{};
    std::array<std::uint32_t, 2> by{};
    point3 position{};  ///< the exact point rounded to nearest
    friend bool operator==(const curve_point&, const curve_point&) = default;
};

/// A path of different points, each joined to the next by a segment.
struct curve_path {
    std::vector<std::uint32_t> points;  ///< numbers in `curve_network::points`; one or more
    std::vector<std::uint32_t> pairs;   ///< the first pair of each segment, or of the single point
    bool closed = false;                ///< a segment leads from the last point to the first
    friend bool operator==(const curve_path&, const curve_path&) = default;
};

/// All curves of a mesh.
struct curve_network {
    std::vector<curve_point> points;  ///< no two are equal as exact points
    /// Open paths come first. At each end of an open path, no other segment ends, or at least two
    /// others do. Then closed paths. Last single points: contacts of faces that are on no segment.
    std::vector<curve_path> paths;
};

/// The segments of `intersection_curves`, joined into paths where their ends are equal as exact
/// points.
///
/// A segment common to several pairs is listed once. Points are in the order of the edges and faces
/// that define them, paths by the number of their first point. Pairs of kind `degenerate` are
/// skipped: a face without area defines no curve.
///
/// \throws std::invalid_argument naming the pair with a face or a corner that is out of range or
///         not finite; for a face without area in a pair of another kind
/// \cost O(P log P) for P pairs
/// \same on any number of threads
[[nodiscard]] TREEFORM_API curve_network intersection_paths(mesh_view mesh,
                                                            std::span<const face_pair> pairs);

/// The name of a column, and an integer for each pair [P].
using pair_column = std::pair<std::string, std::vector<std::uint32_t>>;

/// Writes the paths of `intersection_paths` as polylines. `format` is `obj` (`v` and `l`) or `ply`
/// (text, with an element `edge`); if empty, the extension of `path`. In a PLY, each segment has
/// the values of its first pair in `numbers`, as columns. Faces without area have no paths; for
/// their pairs, single segments are written (`intersection_curves`). "-" is standard output.
///
/// \pre    faces of `pairs` and their corners are in range, coordinates finite
/// \throws io_error for another format, or if the file cannot be written: then a previous file is
///         unchanged
/// \throws std::invalid_argument unless each `pair_column` has one value for each pair
/// \same   bytes on any number of threads
TREEFORM_API void write_curves(const std::filesystem::path& path, mesh_view mesh,
                               std::span<const face_pair> pairs,
                               std::span<const pair_column> numbers = {},
                               const std::string& format = {});

}  // namespace treeform
