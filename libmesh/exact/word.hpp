#pragma once
/// \file
/// Exact arithmetic in machine words, for coordinates of few bits.

#include <cstdint>

namespace treeform::detail::exact {

__extension__ typedef unsigned __int128 uint128;
__extension__ typedef __int128 int128;

/// A value modulo 2^128, read as two's complement. What is less than 2^127 in magnitude at the end
/// is right, whatever its parts were.
struct double_word {
    uint128 bits;
};

/// A coordinate or difference of at most 63 bits and sign.
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
