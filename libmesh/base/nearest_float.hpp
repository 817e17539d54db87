#pragma once
/// \file
/// Rounding a double to the precision of a float, for sure.

namespace treeform::detail::base {

/// The float32 value nearest to `x`, as a double; beyond the range of float32, infinity.
///
/// A cast to float and back does not do. Where g++ 12 turns two such pairs of casts side by side
/// into vectors of two, from -O2 on, it takes the pair for no operation and hands back `x`. The
/// value passes through memory here, so that no compiler sees both casts.
[[nodiscard]] inline double nearest_float(double x) {
    auto rounded = static_cast<float>(x);
    __asm__("" : "+m"(rounded));
    return static_cast<double>(rounded);
}

}  // namespace treeform::detail::base
