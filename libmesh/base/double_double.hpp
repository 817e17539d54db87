#pragma once
/// \file
/// Sums and products in twice the precision of double.
///
/// \source Dekker, A Floating-Point Technique for Extending the Available Precision, Numer. Math.
///         18 (1971)

#include <treeform/mesh/mesh.hpp>

#include <cstddef>

namespace treeform::detail::base {

/// The unevaluated sum of two numbers, the second below half a unit in the last place of the first.
struct double_double {
    double high = 0.0;
    double low = 0.0;
};

/// Exact, for summands in any order.
[[nodiscard]] inline double_double sum_of(double a, double b) {
    const double sum = a + b;
    const double b_there = sum - a;
    return {sum, (a - (sum - b_there)) + (b - b_there)};
}

/// Exact if |a| >= |b| or a == 0.
[[nodiscard]] inline double_double sum_of_ordered(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Splits a number into its upper 26 bits and the rest, which has at most 26 bits.
[[nodiscard]] inline double_double halves_of(double a) {
    const double large = 134217729.0 * a;  // 2^27 + 1
    const double high = large - (large - a);
    return {high, a - high};
}

/// Exact, unless it overflows or underflows.
[[nodiscard]] inline double_double product_of(double a, double b) {
    const double product = a * b;
    const double_double x = halves_of(a), y = halves_of(b);
    const double rest =
        x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low);
    return {product, rest};
}

[[nodiscard]] inline double_double operator+(const double_double& a, const double_double& b) {
    const double_double high = sum_of(a.high, b.high);
    const double_double low = sum_of(a.low, b.low);
    const double_double both = sum_of_ordered(high.high, high.low + low.high);
    return sum_of_ordered(both.high, both.low + low.low);
}

[[nodiscard]] inline double_double operator-(const double_double& a) { return {-a.high, -a.low}; }

[[nodiscard]] inline double_double operator*(double a, const double_double& b) {
    const double_double high = product_of(a, b.high);
    return sum_of_ordered(high.high, high.low + a * b.low);
}

/// a . (b x c): six times the volume of the tetrahedron with the origin.
[[nodiscard]] inline double_double determinant(const point3& a, const point3& b, const point3& c) {
    const auto minor = [&](std::size_t i, std::size_t j) {
        return product_of(b[i], c[j]) + -product_of(b[j], c[i]);
    };
    return a[0] * minor(1, 2) + (a[1] * minor(2, 0) + a[2] * minor(0, 1));
}

}  // namespace treeform::detail::base
