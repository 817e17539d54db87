#pragma once
/// \file
/// Exact arithmetic in machine words, for coordinates with few bits.

#include <cstdint>

namespace treeform::detail::exact {

__extension__ typedef unsigned __int128 uint128;
__extension__ typedef __int128 int128;

/// A value modulo 2^128, in two's complement. A result with a magnitude below 2^127 is correct even
/// if intermediate values overflowed.
struct double_word {
    uint128 bits;
};

/// A coordinate or difference with at most 63 bits and a sign.
struct word {
    std::int64_t value;
};

constexpr word operator-(word a, word b) { return {a.value - b.value}; }
constexpr double_word operator*(word a, word b) {
    return {static_cast<uint128>(static_cast<int128>(a.value) * b.value)};
}
constexpr double_word operator*(double_word a, word b) {
    return {a.bits * static_cast<uint128>(static_cast<int128>(b.value))};
}
constexpr double_word operator*(double_word a, double_word b) { return {a.bits * b.bits}; }
constexpr double_word operator+(double_word a, double_word b) { return {a.bits + b.bits}; }
constexpr double_word operator-(double_word a, double_word b) { return {a.bits - b.bits}; }

constexpr int sign_of(double_word a) {
    return static_cast<std::int64_t>(a.bits >> 64) < 0 ? -1 : a.bits != 0;
}

}  // namespace treeform::detail::exact
