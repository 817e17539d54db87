#pragma once
/// \file
/// What is kept of each group: a point, a place, a row of properties; and the order of the points.

#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::weld {

/// The mean of values that come one by one, rounded as the header of `weld` says; NaN when one is
/// not finite. Where a sum of differences is beyond the doubles it is taken of values scaled by
/// 2^-64: 2^32 differences of less than 2^961 each. What this drops of small values is nothing
/// beside such differences.
class running_mean {
  public:
    void add(double value) {
        if (count_++ == 0) first_ = value;
        sum_ += value - first_;
        scaled_sum_ += value * scale - first_ * scale;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }

    /// \pre at least one value was added
    [[nodiscard]] double value() const {
        const auto count = static_cast<double>(count_);
        const double direct = first_ + sum_ / count;
        const double result =
            std::isfinite(direct) ? direct : (first_ * scale + scaled_sum_ / count) / scale;
        // NaN or infinite if one of the values is infinite.
        const bool finite = std::isfinite(low_) && std::isfinite(high_) && !std::isnan(result);
        return finite ? std::clamp(result, low_, high_) : std::numeric_limits<double>::quiet_NaN();
    }

  private:
    static constexpr double scale = 0x1p-64;

    std::uint64_t count_ = 0;
    double first_ = 0.0;
    double sum_ = 0.0;
    double scaled_sum_ = 0.0;
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

/// [V] The points in the order requested by `options`; empty: by number.
///
/// \throws std::invalid_argument as `weld`
[[nodiscard]] std::vector<std::uint32_t> points_in_order(points_view points,
                                                         const attributes& properties,
                                                         const weld_options& options);

/// Like `find_groups` with the points processed in `order`, which is empty only without points. The
/// result refers to the original point numbers.
[[nodiscard]] point_groups find_groups_in_order(const char* called, points_view points,
                                                const weld_options& options,
                                                std::span<const std::uint32_t> order);

/// Makes the point of each group that is earliest in `order` its first point.
void put_earliest_first(std::span<const std::uint32_t> order, point_groups& groups);

/// [G] The point whose properties each group keeps.
///
/// \throws std::invalid_argument when `options.keep_by` is set but names no property
[[nodiscard]] std::vector<std::uint32_t> kept_points(points_view points,
                                                     const attributes& properties,
                                                     const weld_options& options,
                                                     const point_groups& groups);

/// The points of each group.
class group_members {
  public:
    explicit group_members(const point_groups& groups);

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// The points of a group, ascending.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
        return {members_.data() + begin_[group], members_.data() + begin_[group + 1]};
    }

  private:
    std::vector<std::uint32_t> begin_;    ///< [G + 1]
    std::vector<std::uint32_t> members_;  ///< group by group
};

/// Replaces the position of each group of several points by the mean of its points.
void take_means(points_view points, const group_members& members, std::vector<point3>& places);

/// The same for every floating-point column of `rows`, which has one row for each group; `vertices`
/// is the source element.
void take_means(const element& vertices, const group_members& members, element& rows);

}  // namespace treeform::detail::weld
