#pragma once
/// \file
/// Whether a double is a value of an integer type.

#include <cmath>
#include <limits>
#include <type_traits>

namespace treeform::detail::io {

/// Whether x is a value of the integer type T. The limits are powers of two, which are exact in
/// double.
template <class T>
requires std::is_integral_v<T>
[[nodiscard]] bool is_value_of(double x) {
    constexpr T half = std::numeric_limits<T>::max() / 2 + 1;
    constexpr double beyond = 2.0 * static_cast<double>(half);
    constexpr auto least = static_cast<double>(std::numeric_limits<T>::min());
    return x >= least && x < beyond && x == std::floor(x);
}

}  // namespace treeform::detail::io
