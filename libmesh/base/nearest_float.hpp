#pragma once
/// \file
/// Rounds a double to the precision of a float, on all compilers.

namespace treeform::detail::base {

/// The float32 value nearest to `x`, as a double; beyond the range of float32, infinity.
///
/// A cast to float and back is not enough: g++ 12, from -O2 on, vectorizes two adjacent pairs of
/// casts and then drops them as no operation, returning `x`. Here the value passes through memory,
/// so that no compiler sees both casts.
[[nodiscard]] inline double nearest_float(double x) {
    auto rounded = static_cast<float>(x);
    __asm__("" : "+m"(rounded));
    return static_cast<double>(rounded);
}

}  // namespace treeform::detail::base
