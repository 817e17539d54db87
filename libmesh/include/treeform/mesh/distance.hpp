#pragma once
/// \file
/// Distances: of two meshes, and of points from a mesh.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// The nearest points of two meshes.
struct closest_points_result {
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    double distance = 0.0;  ///< not squared; exactly 0 if and only if the meshes meet
    point3 on_a;            ///< rounded, as is `on_b`
    point3 on_b;
    friend bool operator==(const closest_points_result&, const closest_points_result&) = default;
};

/// The nearest points of the surfaces `a` and `b`, none when one has no faces or they are further
/// apart than `radius` (inclusive). A mesh inside a closed one is as far as from its surface.
///
/// `tree_a` and `tree_b` are trees over the faces' boxes; either may are treated as transformed
/// (`treeform::transformed`), then so do the points, rounded to double (`treeform::transform`), and
/// the answer is about these.
///
/// That meshes meet is decided exactly. The distance otherwise is within 16 u L of the true one,
/// where u = 2^-53 and L is the largest distance of two corners of the faces named; of pairs of
/// faces that are as near, as computed, the one of the lowest numbers is named, but when meshes
/// meet it may be any pair that does, the same in every run.
///
/// \pre    coordinates of corners are finite, the trees are those of the meshes' faces
/// \throws std::invalid_argument when a tree has another size than its mesh, or the radius is
///         negative or NaN
/// \cost   see `nearest_pair`; most pairs of faces are passed over by the direction between the
///         nearest points so far, which separates them by more
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<closest_points_result> mesh_distance(
    mesh_view a, const transformed<3>& tree_a, mesh_view b, const transformed<3>& tree_b,
    double radius = std::numeric_limits<double>::infinity());

/// The same, trees and all.
/// \throws std::invalid_argument naming a face with a corner out of range or is not finite
[[nodiscard]] TREEFORM_API std::optional<closest_points_result> mesh_distance(
    mesh_view a, mesh_view b, double radius = std::numeric_limits<double>::infinity());

/// The point of a mesh that is nearest to a query.
struct closest_point_result {
    std::uint32_t face = 0;
    double distance = 0.0;  ///< not squared
    point3 point;           ///< on the face, rounded
    friend bool operator==(const closest_point_result&, const closest_point_result&) = default;
};

/// A tree over the F faces of a mesh, with a copy of its triangles in leaf order.
///
/// The distance is within 16 u L of the true one, where u = 2^-53 and L is the larger of the
/// distance and the diagonal of the face's box, and in any case a rounding of the coordinates
/// times u. Degenerate faces count as the segment or point they are. Where several faces are as
/// near, as computed, the one with the lowest number is named.
///
/// Queries are const and may run on any threads. `radius` is inclusive and not squared.
///
/// \cost 128 bytes a face. A query opens O(log F) nodes where the nearest point is clear, more when
///       much of the mesh is about as far; many when it is further off than 1e5 times the extent
class TREEFORM_API closest_point_query {
  public:
    static constexpr double any_distance = std::numeric_limits<double>::infinity();

    /// No face, nothing near.
    closest_point_query() = default;

    /// Copies what it needs.
    /// \throws std::invalid_argument naming the face with a corner out of range or not finite
    /// \same   on any number of threads
    explicit closest_point_query(mesh_view mesh);

    [[nodiscard]] std::size_t size() const { return tree_.size(); }
    [[nodiscard]] const tree<3>& faces_tree() const { return tree_; }

    /// The nearest point, none when the mesh has no faces or all are beyond the radius.
    /// \throws std::invalid_argument for a query that is not finite, a radius negative or NaN
    [[nodiscard]] std::optional<closest_point_result> nearest(const point3& query,
                                                              double radius = any_distance) const;

    /// [Q] The same for many queries, in their order, run in parallel and in the order of space.
    /// \throws std::invalid_argument naming the query
    /// \same   on any number of threads: as the single queries
    [[nodiscard]] std::vector<std::optional<closest_point_result>> nearest(
        std::span<const point3> queries, double radius = any_distance) const;

  private:
    tree<3> tree_;
    detail::buffer<double> triangles_;  ///< [blocks][12][8] in leaf order, times `unit_`
    double unit_ = 1.0;                 ///< a power of two that keeps squares in range
    double largest_ = 0.0;              ///< magnitude of a coordinate
};

}  // namespace treeform
