#pragma once
/// \file
/// A mesh that is asked which of its points is nearest.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::nearness {

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
    explicit closest_point_query(mesh_view mesh, const char* function = "closest_point");

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

    /// [Q] The same for queries that are given in an order of space, each with a radius of its own:
    /// the smaller, the faster.
    /// \pre  as many radii as queries, not negative
    /// \throws std::invalid_argument naming the query
    /// \same   on any number of threads: as the single queries
    [[nodiscard]] std::vector<std::optional<closest_point_result>> nearest_in_order(
        std::span<const point3> queries, std::span<const double> radii) const;

  private:
    template <class NumberOf, class RadiusOf>
    [[nodiscard]] std::vector<std::optional<closest_point_result>> answers(
        std::span<const point3> queries, const NumberOf& number_of,
        const RadiusOf& radius_of) const;

    tree<3> tree_;
    buffer<double> triangles_;  ///< [blocks][12][8] in leaf order, times `unit_`
    double unit_ = 1.0;         ///< a power of two that keeps squares in range
    double largest_ = 0.0;      ///< magnitude of a coordinate
};

/// That of a prepared mesh, which keeps it.
[[nodiscard]] const closest_point_query& closest_point_query_of(const prepared_mesh& mesh);

}  // namespace treeform::detail::nearness
