#pragma once
/// \file
/// Stages 2 and 3: the sign of a polynomial in integers, for all finite doubles.
///
/// Coordinates are integers of m bits on the lattice of the call, differences of m + 1 bits. With
/// Polynomial::growth g and degree k, |value| < 2^(g + k (m + 1)), so it is known from its residue
/// modulo 2^w when g + k (m + 1) < w. At L limbs a coordinate the value has w = 64 k L bits. A
/// partial result that is multiplied once more must fit by itself: components of n (two products
/// of degree 2) and of n x m (two products of those) do for all m <= 64 L - 2,
///     1 + 2 (m + 1) < 128 L   and   3 + 4 (m + 1) < 256 L.
/// Finite doubles span 2098 bits, and 33 limbs hold them at every degree used.

#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/lattice.hpp>
#include <libmesh/exact/polynomials.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::exact {

/// Limbs for each coordinate in each width class; class 0 is `word`, with all results in 128 bits.
inline constexpr std::array<std::size_t, predicate_counters::widths> limbs_of_class = {0, 1,  2, 4,
                                                                                       8, 16, 33};

/// Maximum number of bits of a coordinate in a class; see the top of this file.
template <class Polynomial>
constexpr int most_bits(std::size_t width_class) {
    const int limbs = std::max(1, static_cast<int>(limbs_of_class[width_class]));
    const int value_bits = width_class == 0 ? 128 : 64 * Polynomial::degree * limbs;
    return std::min(64 * limbs - 2, (value_bits - 1 - Polynomial::growth) / Polynomial::degree - 1);
}

/// 1 if the vector has a nonzero component, otherwise 0.
template <class Number>
constexpr int sign_of(const vector3<Number>& v) {
    return sign_of(v.x) != 0 || sign_of(v.y) != 0 || sign_of(v.z) != 0;
}

template <class Polynomial, class Number>
using points_of = std::array<typename Polynomial::template vector<Number>, Polynomial::points>;

/// Sign of the polynomial at one width. \pre grid.bits() <= most_bits(Class)
template <class Polynomial, std::size_t Class>
[[nodiscard]] inline int sign_at_width(const lattice& grid,
                                       const points_of<Polynomial, odd_part>& points) {
    const auto on_grid = [&](const odd_part& p) {
        if constexpr (Class == 0)
            return word_on(grid, p);
        else
            return integer_on<limbs_of_class[Class]>(grid, p);
    };
    return sign_of(Polynomial::value(Polynomial::differences(transform(points, on_grid))));
}

/// `sign_at_width`, not inlined: keeps large integers out of the caller's stack frame.
template <class Polynomial, std::size_t Class>
[[gnu::noinline, nodiscard]] int sign_at_large_width(
    const lattice& grid, const points_of<Polynomial, odd_part>& points) {
    return sign_at_width<Polynomial, Class>(grid, points);
}

/// The narrowest class for coordinates of this many bits.
template <class Polynomial>
[[nodiscard]] constexpr std::size_t width_class_of(int bits) {
    std::size_t width_class = 0;
    while (bits > most_bits<Polynomial>(width_class)) ++width_class;
    return width_class;
}

/// Sign of the polynomial at one of the large widths.
template <class Polynomial>
[[gnu::noinline, nodiscard]] int sign_at_large_widths(const points_of<Polynomial, double>& points,
                                                      predicate_counters* counters) {
    const auto parts = transform(points, odd_part_of);
    lattice grid;
    for_each_component(parts, [&](const odd_part& p) { grid.add(p); });
    const std::size_t width_class = width_class_of<Polynomial>(grid.bits());
    if (counters) ++counters->by_width[width_class];
    switch (width_class) {
        case 0:
            return sign_at_width<Polynomial, 0>(grid, parts);
        case 1:
            return sign_at_width<Polynomial, 1>(grid, parts);
        case 2:
            return sign_at_large_width<Polynomial, 2>(grid, parts);
        case 3:
            return sign_at_large_width<Polynomial, 3>(grid, parts);
        case 4:
            return sign_at_large_width<Polynomial, 4>(grid, parts);
        case 5:
            return sign_at_large_width<Polynomial, 5>(grid, parts);
        default:
            return sign_at_large_width<Polynomial, 6>(grid, parts);
    }
}

/// Sign of the polynomial. Counts the width class used.
template <class Polynomial>
[[nodiscard]] inline int exact_sign(const points_of<Polynomial, double>& points,
                                    predicate_counters* counters) {
    static_assert(most_bits<Polynomial>(6) >= 2098);
    const word_scale scale(largest_magnitude(points));
    if (scale.usable()) {
        std::uint64_t differing = 0;
        std::uint64_t all = 0;
        const auto words = transform(points, [&](double x) {
            const word w = scale.word_of(x, differing);
            all |= static_cast<std::uint64_t>(w.value);
            return w;
        });
        const int zeros = std::countr_zero(all);
        const int bits = word_scale::bits - zeros;
        if (differing << 1 == 0 && bits <= most_bits<Polynomial>(1)) {
            if (bits <= most_bits<Polynomial>(0)) {
                if (counters) ++counters->by_width[0];
                return sign_of(Polynomial::value(Polynomial::differences(
                    transform(words, [&](word w) { return word{w.value >> zeros}; }))));
            }
            if (counters) ++counters->by_width[1];
            return sign_of(Polynomial::value(Polynomial::differences(transform(
                words, [](word w) { return integer<1>{static_cast<std::uint64_t>(w.value)}; }))));
        }
    }
    return sign_at_large_widths<Polynomial>(points, counters);
}

}  // namespace treeform::detail::exact
