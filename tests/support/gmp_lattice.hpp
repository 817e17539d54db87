#pragma once
/// \file
/// Pairs of triangles in GMP's integers on one power-of-two lattice, and what they have in common.

#include <gmpxx.h>
#include <support/reference_intersection.hpp>
#include <support/stress_families.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::test {

inline void reduce(homogeneous<mpz_class>&) {}  // numbers stay short enough

using gmp_reference = reference_intersection<mpz_class>;
using gmp_triangle = triangle_of<mpz_class>;

/// x = mantissa * 2^exponent, mantissa odd or 0.
struct binary {
    std::int64_t mantissa = 0;
    int exponent = std::numeric_limits<int>::max();
};

inline binary decoded(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>(bits >> 52 & 0x7ff);
    std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
    if (biased != 0) mantissa |= std::uint64_t{1} << 52;
    if (mantissa == 0) return {};
    const int shift = std::countr_zero(mantissa);
    const auto magnitude = static_cast<std::int64_t>(mantissa >> shift);
    return {x < 0 ? -magnitude : magnitude, std::max(biased, 1) - 1075 + shift};
}

struct lattice_pair {
    gmp_triangle a;
    gmp_triangle b;
    int exponent;  ///< of the lattice step
};

inline lattice_pair on_lattice(const triangle_pair& pair) {
    int step = std::numeric_limits<int>::max();
    for (const triangle3* t : {&pair.a, &pair.b})
        for (const point3& p : *t)
            for (std::size_t axis = 0; axis < 3; ++axis)
                step = std::min(step, decoded(p[axis]).exponent);
    const auto integral = [&](const triangle3& t) {
        gmp_triangle result;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const binary x = decoded(t[i][axis]);
                if (x.mantissa != 0)
                    result[i][axis] = mpz_class(static_cast<long>(x.mantissa))
                                      << static_cast<unsigned long>(x.exponent - step);
            }
        return result;
    };
    return {integral(pair.a), integral(pair.b), step == std::numeric_limits<int>::max() ? 0 : step};
}

}  // namespace treeform::test
