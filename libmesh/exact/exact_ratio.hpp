#pragma once
/// \file
/// The quotient of two polynomials of the same degree, computed in integers and rounded once at the
/// end.

#include <libmesh/exact/exact_sign.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::exact {

/// mantissa * 2^exponent.
struct scaled_double {
    double mantissa;
    int exponent;
};

/// The integer with a relative error below 2^-52.
template <std::size_t Limbs>
[[nodiscard]] scaled_double scaled(const integer<Limbs>& a) {
    const integer<Limbs> magnitude = a.negative() ? integer<Limbs>{} - a : a;
    std::size_t top = Limbs - 1;
    while (top > 0 && magnitude.limbs[top] == 0) --top;
    if (top == 0) {
        const auto x = static_cast<double>(magnitude.limbs[0]);
        return {a.negative() ? -x : x, 0};
    }
    // Includes at least the 64 leading bits.
    const double x = std::ldexp(static_cast<double>(magnitude.limbs[top]), 64) +
                     static_cast<double>(magnitude.limbs[top - 1]);
    return {a.negative() ? -x : x, 64 * static_cast<int>(top - 1)};
}

template <class Polynomial, std::size_t Class>
[[gnu::noinline, nodiscard]] double ratio_at_width(const lattice& grid,
                                                   const points_of<Polynomial, odd_part>& points) {
    const auto on_grid = [&](const odd_part& p) {
        return integer_on<limbs_of_class[Class]>(grid, p);
    };
    const auto value = Polynomial::value(Polynomial::differences(transform(points, on_grid)));
    const scaled_double num = scaled(value.x);
    const scaled_double den = scaled(value.y);
    return std::ldexp(num.mantissa / den.mantissa, num.exponent - den.exponent);
}

/// x / y for the value (x, y) of the polynomial, with a relative error below 2^-49 unless the
/// quotient is denormal. \pre y != 0
template <class Polynomial>
[[nodiscard]] double exact_ratio(const points_of<Polynomial, double>& points) {
    const auto parts = transform(points, odd_part_of);
    lattice grid;
    for_each_component(parts, [&](const odd_part& p) { grid.add(p); });
    switch (width_class_of<Polynomial>(grid.bits())) {
        case 0:
        case 1:
            return ratio_at_width<Polynomial, 1>(grid, parts);
        case 2:
            return ratio_at_width<Polynomial, 2>(grid, parts);
        case 3:
            return ratio_at_width<Polynomial, 3>(grid, parts);
        case 4:
            return ratio_at_width<Polynomial, 4>(grid, parts);
        case 5:
            return ratio_at_width<Polynomial, 5>(grid, parts);
        default:
            return ratio_at_width<Polynomial, 6>(grid, parts);
    }
}

}  // namespace treeform::detail::exact
