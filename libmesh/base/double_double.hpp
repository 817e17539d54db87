#pragma once
/// \file
/// Sums and products in twice the precision of double.
///
/// \source Dekker, A Floating-Point Technique for Extending the Available Precision, Numer. Math.
///         18 (1971)

#include <cstddef>

namespace treeform::detail::base {

/// The unevaluated sum of two numbers, the second below half a unit in the last place of the first.
/// `Real` is double, or a vector of doubles, on each of which the same is done.
template <class Real>
struct doubled {
    Real high{};
    Real low{};
};

using double_double = doubled<double>;

/// Exact. Needs no order of the summands.
template <class Real>
[[nodiscard]] doubled<Real> sum_of(const Real& a, const Real& b) {
    const Real sum = a + b;
    const Real b_there = sum - a;
    return {sum, (a - (sum - b_there)) + (b - b_there)};
}

/// Exact, where |a| >= |b| or a == 0.
template <class Real>
[[nodiscard]] doubled<Real> sum_of_ordered(const Real& a, const Real& b) {
    const Real sum = a + b;
    return {sum, b - (sum - a)};
}

/// The upper 26 bits, and the rest, which has as many.
template <class Real>
[[nodiscard]] doubled<Real> halves_of(const Real& a) {
    const Real large = 134217729.0 * a;  // 2^27 + 1
    const Real high = large - (large - a);
    return {high, a - high};
}

/// Exact, away from the ends of double's range.
template <class Real>
[[nodiscard]] doubled<Real> product_of(const Real& a, const Real& b) {
    const Real product = a * b;
    const doubled<Real> x = halves_of(a), y = halves_of(b);
    const Real rest =
        x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low);
    return {product, rest};
}

template <class Real>
[[nodiscard]] doubled<Real> operator+(const doubled<Real>& a, const doubled<Real>& b) {
    const doubled<Real> high = sum_of(a.high, b.high);
    const doubled<Real> low = sum_of(a.low, b.low);
    const doubled<Real> both = sum_of_ordered<Real>(high.high, high.low + low.high);
    return sum_of_ordered<Real>(both.high, both.low + low.low);
}

template <class Real>
[[nodiscard]] doubled<Real> operator-(const doubled<Real>& a) {
    return {-a.high, -a.low};
}

template <class Real>
[[nodiscard]] doubled<Real> operator*(const Real& a, const doubled<Real>& b) {
    const doubled<Real> high = product_of(a, b.high);
    return sum_of_ordered<Real>(high.high, high.low + a * b.low);
}

/// a . (b x c): six times the volume of the tetrahedron with the origin.
template <class Point>
[[nodiscard]] auto determinant(const Point& a, const Point& b, const Point& c) {
    const auto minor = [&](std::size_t i, std::size_t j) {
        return product_of(b[i], c[j]) + -product_of(b[j], c[i]);
    };
    return a[0] * minor(1, 2) + (a[1] * minor(2, 0) + a[2] * minor(0, 1));
}

}  // namespace treeform::detail::base
