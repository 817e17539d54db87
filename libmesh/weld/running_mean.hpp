#pragma once
/// \file
/// The mean of values added one by one.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace treeform::detail::weld {

/// Rounded as documented for `weld`; NaN if a value is not finite. If a sum of differences
/// overflows, values scaled by 2^-64 are summed instead: 2^32 differences of less than 2^961 each.
/// The loss of small values by scaling is negligible next to such differences.
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

}  // namespace treeform::detail::weld
