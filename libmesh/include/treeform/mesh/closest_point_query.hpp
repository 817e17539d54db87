#pragma once
/// \file
/// A mesh that is asked which of its points is nearest.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// The point of a mesh that is nearest to a query.
struct mesh_point {
    std::uint32_t face = 0;
    double distance = 0.0;  ///< not squared
    point3 point;           ///< on the face, rounded
    friend bool operator==(const mesh_point&, const mesh_point&) = default;
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
    /// \throws std::invalid_argument naming the face with a corner that is no point or not finite
    /// \same   on any number of threads
    explicit closest_point_query(mesh_view mesh);

    [[nodiscard]] std::size_t size() const { return tree_.size(); }
    [[nodiscard]] const tree<3>& faces_tree() const { return tree_; }

    /// The nearest point, none when the mesh has no faces or all are beyond the radius.
    /// \throws std::invalid_argument for a query that is not finite, a radius negative or NaN
    [[nodiscard]] std::optional<mesh_point> nearest(const point3& query,
                                                    double radius = any_distance) const;

    /// [Q] The same for many queries, in their order, run in parallel and in the order of space.
    /// \throws std::invalid_argument naming the query
    /// \same   on any number of threads: as the single queries
    [[nodiscard]] std::vector<std::optional<mesh_point>> nearest(
        std::span<const point3> queries, double radius = any_distance) const;

  private:
    tree<3> tree_;
    detail::buffer<double> triangles_;  ///< [blocks][12][8] in leaf order, times `unit_`
    double unit_ = 1.0;                 ///< a power of two that keeps squares in range
    double largest_ = 0.0;              ///< magnitude of a coordinate
};

}  // namespace treeform
