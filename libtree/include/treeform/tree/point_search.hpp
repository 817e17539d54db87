#pragma once
/// \file
/// Nearest points in point clouds: k nearest, and all within a radius.

#include <treeform/tree/answers.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/nearness.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <ranges>
#include <span>
#include <tuple>
#include <vector>

namespace treeform {

/// A point of the cloud near a query, and its distance.
struct near_point {
    std::uint32_t id = 0;
    double distance = 0.0;  ///< not squared
    friend bool operator==(const near_point&, const near_point&) = default;
};

namespace detail {

template <class Point>
concept has_xy = requires(const Point& p) {
    static_cast<double>(p.x);
    static_cast<double>(p.y);
};
template <class Point>
concept has_xyz = has_xy<Point> && requires(const Point& p) {
    static_cast<double>(p.z);
};

template <class Point, std::size_t D>
concept indexed = requires(const Point& p) {
    static_cast<double>(p[D - 1]);
}
&&!requires { requires std::tuple_size<Point>::value != D; };
/// A position in D dimensions: members x, y (and z), or D numbers by [].
template <class Point, std::size_t D>
concept position = (has_xy<Point> && D == (has_xyz<Point> ? 3 : 2)) ||
                   (!has_xy<Point> && indexed<Point, D>);

template <std::size_t D, class Point>
[[nodiscard]] constexpr std::array<double, D> coordinates_of(const Point& p) {
    std::array<double, D> all{};
    if constexpr (has_xy<Point>) {
        all[0] = static_cast<double>(p.x);
        all[1] = static_cast<double>(p.y);
        if constexpr (D == 3) all[2] = static_cast<double>(p.z);
    } else {
        for (std::size_t k = 0; k < D; ++k) all[k] = static_cast<double>(p[k]);
    }
    return all;
}

/// Many positions, other than an array of `point_search::point`.
template <class Points, std::size_t D>
concept positions = std::ranges::sized_range<const Points> &&
    position<std::ranges::range_value_t<const Points>, D> &&
    !std::convertible_to<const Points&, std::span<const std::array<double, D>>>;

}  // namespace detail

/// A tree over N points, with a copy of their coordinates in leaf order.
///
/// Points and queries are of any type with members x, y (and z), or with [].
///
/// Distances are computed in double. The relative error of a squared distance is at most 2^-50; a
/// distance below 1e-150 times the largest coordinate of the query and the cloud may be wrong by
/// that much. Equally near points are ordered by id. Points may be equal.
///
/// Queries are const and may run concurrently. `radius` is inclusive and not squared.
/// Coordinates of a query that are not finite, or a negative radius, throw std::invalid_argument.
///
/// \cost   56 bytes a point with D = 3, 40 with D = 2. A search opens O(log N + k) nodes for most
///         queries; many if the query is further away than 1e5 times the extent of the cloud
/// \source the tree and its search: nearness.hpp
template <std::size_t D>
class TREEFORM_API point_search {
  public:
    using point = std::array<double, D>;

    /// An empty cloud, in which searches find nothing.
    point_search() = default;

    /// Copies the coordinates of the points of any range. `position_of` returns the position of an
    /// element. It is a function or a pointer to a member, as in
    /// `point_search<3>(stars, &star::at)`.
    ///
    /// \throws std::invalid_argument naming the first point that is not finite
    /// \same   on any number of threads
    template <std::ranges::random_access_range Points, class Position = std::identity>
    requires(!std::same_as<Points, point_search>) explicit point_search(
        const Points& points, const Position& position_of = {})
        : tree_(build(points, [&](const auto& element) {
              const point p = detail::coordinates_of<D>(std::invoke(position_of, element));
              return aabb<double, D>{p, p};
          })) {
        copy(points, position_of);
    }

    [[nodiscard]] std::size_t size() const { return tree_.size(); }
    /// The tree over the points, valid during the lifetime of this object. Its ids are the numbers
    /// of the points.
    [[nodiscard]] const tree<D>& points_tree() const { return tree_; }

    /// The nearest point; none if all are beyond the radius.
    [[nodiscard]] std::optional<near_point> nearest(const point& query,
                                                    double radius = unlimited_radius) const;
    /// The k nearest points, nearest first.
    [[nodiscard]] std::vector<near_point> k_nearest(const point& query, std::size_t k,
                                                    double radius = unlimited_radius) const;
    /// All points within `radius`, nearest first.
    [[nodiscard]] std::vector<near_point> all_within(const point& query, double radius) const;
    template <detail::position<D> Query>
    [[nodiscard]] std::optional<near_point> nearest(const Query& query,
                                                    double radius = unlimited_radius) const {
        return nearest(detail::coordinates_of<D>(query), radius);
    }
    template <detail::position<D> Query>
    [[nodiscard]] std::vector<near_point> k_nearest(const Query& query, std::size_t k,
                                                    double radius = unlimited_radius) const {
        return k_nearest(detail::coordinates_of<D>(query), k, radius);
    }
    template <detail::position<D> Query>
    [[nodiscard]] std::vector<near_point> all_within(const Query& query, double radius) const {
        return all_within(detail::coordinates_of<D>(query), radius);
    }

    /// [Q] The same for many queries in parallel, in the order of the queries, with the same
    /// results as single searches.
    [[nodiscard]] answer_lists<near_point> k_nearest(std::span<const point> queries, std::size_t k,
                                                     double radius = unlimited_radius) const;
    [[nodiscard]] answer_lists<near_point> all_within(std::span<const point> queries,
                                                      double radius) const;
    template <detail::positions<D> Queries>
    [[nodiscard]] answer_lists<near_point> k_nearest(const Queries& queries, std::size_t k,
                                                     double radius = unlimited_radius) const {
        return k_nearest(std::span<const point>(points_of(queries)), k, radius);
    }
    template <detail::positions<D> Queries>
    [[nodiscard]] answer_lists<near_point> all_within(const Queries& queries, double radius) const {
        return all_within(std::span<const point>(points_of(queries)), radius);
    }

    /// All pairs of points within `radius` of each other, ascending, each once with the lower
    /// number first. None if `progress` returned false; it is always called with 0, since the
    /// remaining work is unknown.
    ///
    /// \cost   O(N log N + P) for P pairs whose points are within about twice the radius; 90 bytes
    ///         a point
    /// \same   on any number of threads
    [[nodiscard]] std::vector<id_pair> pairs_within(double radius,
                                                    const progress_callback& progress = {}) const;

  private:
    template <class Queries>
    [[nodiscard]] static std::vector<point> points_of(const Queries& queries) {
        std::vector<point> all;
        all.reserve(std::ranges::size(queries));
        for (const auto& query : queries) all.push_back(detail::coordinates_of<D>(query));
        return all;
    }
    template <class Points, class Position>
    void copy(const Points& points, const Position& position_of);

    tree<D> tree_;
    /// [blocks][D][8] in leaf order; NaN in slots without a point, so that they are never found.
    detail::buffer<double> coordinates_;
    double largest_ = 0.0;  ///< magnitude of a coordinate
};

template <std::size_t D>
template <class Points, class Position>
void point_search<D>::copy(const Points& points, const Position& position_of) {
    constexpr std::size_t grain = 512;
    const std::size_t blocks = chunk_count(tree_.size(), 8);
    coordinates_.resize(blocks * D * 8);
    std::vector<double> largest(chunk_count(blocks, grain));
    for_chunks(blocks, grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t place = begin * 8; place < end * 8; ++place) {
            double* const slot = coordinates_.data() + place / 8 * D * 8 + place % 8;
            for (std::size_t k = 0; k < D; ++k) {
                slot[k * 8] = std::numeric_limits<double>::quiet_NaN();
                if (place >= tree_.size()) continue;
                const auto id =
                    static_cast<std::ranges::range_difference_t<Points>>(tree_.ids()[place]);
                const auto p = detail::coordinates_of<D>(
                    std::invoke(position_of, std::ranges::begin(points)[id]));
                slot[k * 8] = p[k];
                largest[chunk] = std::max(largest[chunk], std::abs(slot[k * 8]));
            }
        }
    });
    for (const double one : largest) largest_ = std::max(largest_, one);
}

extern template class point_search<2>;
extern template class point_search<3>;

}  // namespace treeform
