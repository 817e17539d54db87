#pragma once
/// \file
/// Doubles at the ends of what a double can be.

#include <limits>

namespace test {

inline constexpr double least = 0x1p-1074;
inline constexpr double greatest = 0x1.fffffffffffffp+1023;
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace test
