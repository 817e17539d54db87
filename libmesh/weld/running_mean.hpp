#pragma once
/// \file
/// The mean of values that come one by one.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace treeform::detail::weld {

/// Rounded as the header of `weld` says; NaN when one of the values is not finite. Where a sum of
/// differences is beyond the doubles it is taken of values scaled by 2^-64: 2^32 differences of
/// less than 2^961 each. What this drops of small values is nothing beside such differences.
class running_mean {
  public:
    void add(double value) {
        if (count_++ == 0) first_ = value;
        sum_ += value - first_;
        scaled_sum_ += value * scale - first_ * scale;
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }

    /// \pre one value at least
    [[nodiscard]] double value() const {
        const auto count = static_cast<double>(count_);
        const double direct = first_ + sum_ / count;
        const double result =
            std::isfinite(direct) ? direct : (first_ * scale + scaled_sum_ / count) / scale;
        // With an infinity among the values this is NaN, or infinite.
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

}  // namespace treeform::detail::weld
