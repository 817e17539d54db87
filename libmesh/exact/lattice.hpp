#pragma once
/// \file
/// Doubles as integers on a common power-of-two lattice. Uses bit operations only, no
/// floating-point operations: denormals are exact even on a processor that flushes them.

#include <libmesh/exact/integer.hpp>
#include <libmesh/exact/vectors.hpp>
#include <libmesh/exact/word.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::detail::exact {

/// A finite double as (-1)^negative * odd * 2^(lowest - 1075); odd is zero for zero.
struct odd_part {
    /// Value of `lowest` for zero, which is on every lattice.
    static constexpr int no_bit = std::numeric_limits<int>::max();

    std::uint64_t odd;       ///< below 2^53
    std::uint64_t negative;  ///< all bits set, or none
    int lowest;              ///< at least 1
    int highest;             ///< least value with magnitude < 2^(highest - 1075); 0 for zero
};

inline odd_part odd_part_of(double x) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    const int field = static_cast<int>(bits >> 52) & 0x7ff;
    const std::uint64_t normal = field != 0;
    const std::uint64_t mantissa = (bits & 0xfffffffffffffu) | normal << 52;
    const int exponent = field + 1 - static_cast<int>(normal);
    if (mantissa == 0) return {0, 0, odd_part::no_bit, 0};
    const int zeros = std::countr_zero(mantissa);
    return {mantissa >> zeros, 0 - (bits >> 63), exponent + zeros,
            exponent + static_cast<int>(std::bit_width(mantissa))};
}

/// The coarsest lattice 2^(lowest - 1075) Z that contains the doubles added.
struct lattice {
    int lowest = odd_part::no_bit;
    int highest = 0;

    /// Bits of the largest magnitude on the lattice; zero or less if all values are zero.
    [[nodiscard]] int bits() const { return highest - lowest; }

    void add(const odd_part& p) {
        lowest = std::min(lowest, p.lowest);
        highest = std::max(highest, p.highest);
    }
};

/// The multiple of the lattice's unit that `p` is. \pre fewer than 64 bits
inline word word_on(const lattice& grid, const odd_part& p) {
    const std::uint64_t magnitude = p.odd << ((p.lowest - grid.lowest) & 63);
    return {static_cast<std::int64_t>((magnitude ^ p.negative) - p.negative)};
}

/// The multiple of the lattice's unit that `p` is. \pre fewer than 64 Limbs bits
template <std::size_t Limbs>
inline integer<Limbs> integer_on(const lattice& grid, const odd_part& p) {
    if constexpr (Limbs == 1) {
        return {static_cast<std::uint64_t>(word_on(grid, p).value)};
    } else if constexpr (Limbs == 2) {
        const uint128 negative = static_cast<uint128>(p.negative) << 64 | p.negative;
        const uint128 magnitude = uint128{p.odd} << ((p.lowest - grid.lowest) & 127);
        const uint128 value = (magnitude ^ negative) - negative;
        return {static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)};
    } else {
        integer<Limbs> magnitude{};
        if (p.odd == 0) return magnitude;
        const auto shift = static_cast<std::size_t>(p.lowest - grid.lowest);
        const uint128 spread = uint128{p.odd} << (shift % 64);
        magnitude.limbs[shift / 64] = static_cast<std::uint64_t>(spread);
        if (shift / 64 + 1 < Limbs)
            magnitude.limbs[shift / 64 + 1] = static_cast<std::uint64_t>(spread >> 64);
        return p.negative != 0 ? integer<Limbs>{} - magnitude : magnitude;
    }
}

/// Coordinates as words, for the usual case that 62 bits suffice for all coordinates of a call:
/// scaled and truncated in floating point, then verified by scaling back and comparing bits. A word
/// w that scales back to x is correct, regardless of rounding or flushing in the conversion: w has
/// at most 53 significant bits and |w| >= 1 stays normal, so scaling back is exact; and w = 0
/// scales back to zero only.
class word_scale {
  public:
    static constexpr int bits = 62;  ///< all words are below 2^62 in magnitude

    explicit word_scale(double largest)
        : field_(static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52)) {}

    /// Whether both scales are normal numbers.
    [[nodiscard]] bool usable() const { return field_ >= bits; }

    /// The word of x. Ors into `differing` the bits in which the word, scaled back, differs from x;
    /// ignore the top bit (-0). \pre |x| <= largest, usable()
    [[nodiscard]] word word_of(double x, std::uint64_t& differing) const {
        const auto value = static_cast<std::int64_t>(x * power(1023 + 1023 + bits - 1 - field_));
        const double back = static_cast<double>(value) * power(field_ - bits + 1);
        differing |= std::bit_cast<std::uint64_t>(back) ^ std::bit_cast<std::uint64_t>(x);
        return {value};
    }

    /// The weight of a word is 2^unit().
    [[nodiscard]] int unit() const { return field_ - 1023 - bits + 1; }

  private:
    static double power(int biased) {
        return std::bit_cast<double>(static_cast<std::uint64_t>(biased) << 52);
    }
    int field_;  ///< biased exponent of the largest magnitude
};

}  // namespace treeform::detail::exact
