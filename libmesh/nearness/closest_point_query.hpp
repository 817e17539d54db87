#pragma once
/// \file
/// Closest-point queries on a mesh.

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
/// The distance is within 16 u L of the true one, plus u times the largest coordinate, where u =
/// 2^-53 and L is the larger of the distance and the diagonal of the box of the face. Degenerate
/// faces count as segments or points. If several faces have the same computed distance, the one
/// with the lowest number is returned.
///
/// Queries are const and thread-safe. `radius` is inclusive and not squared.
///
/// \cost 128 bytes a face. A query opens O(log F) nodes if the nearest point is unambiguous, more
///       if much of the mesh is at about the same distance, and many if the query is farther away
///       than 1e5 times the extent of the mesh
class TREEFORM_API closest_point_query {
  public:
    static constexpr double unlimited_radius = std::numeric_limits<double>::infinity();

    /// An empty mesh; queries find nothing.
    closest_point_query() = default;

    /// Copies the triangles; `mesh` need not outlive the query object.
    /// \throws std::invalid_argument naming the face with a corner out of range or not finite
    /// \same   on any number of threads
    explicit closest_point_query(mesh_view mesh, const char* function = "closest_point");

    [[nodiscard]] std::size_t size() const { return tree_.size(); }
    [[nodiscard]] const tree<3>& faces_tree() const { return tree_; }

    /// The nearest point; empty if the mesh has no faces or all are farther than the radius.
    /// \throws std::invalid_argument for a query that is not finite, or a radius that is negative
    ///         or NaN
    [[nodiscard]] std::optional<closest_point_result> nearest(
        const point3& query, double radius = unlimited_radius) const;

    /// [Q] The nearest point of each query, in the given order. Queries run in parallel, sorted
    /// along a space-filling curve.
    /// \throws std::invalid_argument naming the query
    /// \same   on any number of threads: as the single queries
    [[nodiscard]] std::vector<std::optional<closest_point_result>> nearest(
        std::span<const point3> queries, double radius = unlimited_radius) const;

    /// [Q] The same for queries that are already in a spatial order, with one radius for each;
    /// smaller radii are faster.
    /// \pre  one radius for each query, not negative
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
    double largest_ = 0.0;      ///< largest magnitude of a coordinate
};

/// The query object of a prepared mesh, cached in the mesh.
[[nodiscard]] const closest_point_query& closest_point_query_of(const prepared_mesh& mesh);

}  // namespace treeform::detail::nearness
