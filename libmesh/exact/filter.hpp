#pragma once
/// \file
/// Stage 1: the sign of a polynomial in double arithmetic, or `undecided`.
///
/// The value is computed together with its permanent P: the same polynomial with every difference
/// replaced by its magnitude and every minus by plus. Let d^ be a computed difference, d the exact
/// one, u = 2^-52 (twice the unit roundoff of rounding to nearest, so that every rounding mode is
/// covered), and P^ the computed permanent.
///
/// Rounding. d^ = d (1 + e) with |e| <= u, also written d = d^ (1 + e'). Each further operation
/// multiplies its result by one (1 + e), and fusing a product with a sum removes one. So computed
/// and exact value are sums of the same products of d^, each times at most K factors (1 + e) in
/// all, K = Polynomial::roundings; hence
///     |value^ - value| <= ((1 + u)^K - 1) P,   P^ >= (1 - u)^K P,   K <= 20,
/// and c P^ with c = (K + 1) u, rounded once more, exceeds the error by more than P u / 2.
///
/// Underflow. An operation may besides lose less than 2^-1020: a result and two operands below
/// 2^-1022, flushed to zero. What is lost is multiplied by at most degree - 1 further differences
/// and their sums. With M the largest |d^| and M^(degree - 1) <= 2^400, fewer than 2^7 operations
/// and |coefficients| below 2^6 lose less than 2^(400 - 1020 + 7 + 6) = 2^-607 in all, which is
/// below P u / 2 when P^ >= 2^-550. Only then is anything decided.
///
/// Overflow. M^degree <= 2^800, so no value is infinite or NaN; if a difference is, M is too large.

#include <libmesh/exact/polynomials.hpp>
#include <libmesh/exact/vectors.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::exact {

/// Returned by a filter when the sign is uncertain.
inline constexpr int undecided = 2;

/// A double whose magnitude is its permanent: a difference or a product of differences.
struct term {
    double value;
    [[nodiscard]] double permanent() const { return std::abs(value); }
};

/// A double with its permanent.
struct sum {
    double value;
    double magnitude;
    [[nodiscard]] double permanent() const { return magnitude; }
};

template <class T>
concept filtered = std::same_as<T, term> || std::same_as<T, sum>;

inline term operator*(term a, term b) { return {a.value * b.value}; }

template <filtered Left, filtered Right>
inline sum operator*(Left a, Right b) {
    return {a.value * b.value, a.permanent() * b.permanent()};
}
template <filtered Left, filtered Right>
inline sum operator+(Left a, Right b) {
    return {a.value + b.value, a.permanent() + b.permanent()};
}
template <filtered Left, filtered Right>
inline sum operator-(Left a, Right b) {
    return {a.value - b.value, a.permanent() + b.permanent()};
}

/// A number type that tests whether every product of a polynomial has a zero factor.
struct vanishing {
    bool zero;
};
inline vanishing operator*(vanishing a, vanishing b) { return {a.zero || b.zero}; }
inline vanishing operator+(vanishing a, vanishing b) { return {a.zero && b.zero}; }
inline vanishing operator-(vanishing a, vanishing b) { return {a.zero && b.zero}; }

/// A coordinate that is only compared for equality, by its bits: a processor that flushes denormals
/// would take different ones for equal.
struct bit_pattern {
    std::uint64_t bits;
    explicit bit_pattern(double x) : bits(std::bit_cast<std::uint64_t>(x)) {
        if (bits << 1 == 0) bits = 0;  // -0
    }
};
inline vanishing operator-(bit_pattern a, bit_pattern b) { return {a.bits == b.bits}; }

/// The error is bounded by this factor times the permanent; see the derivation at the top of this
/// file.
template <class Polynomial>
inline constexpr double error_factor = (Polynomial::roundings + 1) * 0x1p-52;

/// Permanents below this are undecided.
inline constexpr double least_permanent = 0x1p-550;

/// Largest difference M for which the filter decides: the largest power of two with
/// M^(Degree - 1) <= 2^400.
template <int Degree>
inline constexpr double largest_difference =
    std::bit_cast<double>(std::uint64_t{1023 + 400 / (Degree - 1)} << 52);

template <class Vector, std::size_t Count>
inline double largest_magnitude(const std::array<Vector, Count>& vectors) {
    double largest = 0.0;
    for_each_component(vectors, [&](double x) {
        const double magnitude = std::abs(x);
        largest = magnitude > largest ? magnitude : largest;
    });
    return largest;
}

inline vector2<double> vector_of(const vector2<double>& v) { return v; }
inline vector2<double> vector_of(const point2& p) { return {p.x, p.y}; }
inline vector3<double> vector_of(const point3& p) { return {p.x, p.y, p.z}; }

/// Whether every product of the polynomial has a zero factor. If so, its value is zero, for example
/// for points in one axis-parallel plane, or for a repeated point. Not inlined, and with points by
/// value, so that nothing is stored for it when the filter decides.
template <class Polynomial, class... Points>
[[gnu::noinline, nodiscard]] bool vanishes(Points... points) {
    const auto bits =
        transform(std::array{vector_of(points)...}, [](double x) { return bit_pattern(x); });
    return Polynomial::value(Polynomial::differences(bits)).zero;
}

/// Sign of the polynomial: -1, 0, +1, or `undecided`. 0 is returned only if every product has a
/// zero factor.
template <class Polynomial, class... Points>
[[nodiscard]] inline int filter_sign(const Points&... points) {
    const auto d = Polynomial::differences(std::array{vector_of(points)...});
    const sum det = Polynomial::value(transform(d, [](double x) { return term{x}; }));
    if (std::abs(det.value) > error_factor<Polynomial> * det.magnitude &&
        det.magnitude >= least_permanent &&
        largest_magnitude(d) <= largest_difference<Polynomial::degree>)
        return (det.value > 0.0) - (det.value < 0.0);
    if (det.magnitude == 0.0 && vanishes<Polynomial>(points...)) return 0;
    return undecided;
}

/// The coordinates other than `axis`, in cyclic order.
inline vector2<double> projection(int axis, const point3& p) {
    return axis == 0   ? vector2<double>{p.y, p.z}
           : axis == 1 ? vector2<double>{p.z, p.x}
                       : vector2<double>{p.x, p.y};
}

/// Stage 1 of `orient2d`.
[[nodiscard]] inline int orient2d_filter(const point2& a, const point2& b, const point2& c) {
    return filter_sign<orient2d_polynomial>(a, b, c);
}

/// Stage 1 of `orient2d` along an axis.
[[nodiscard]] inline int orient2d_filter(int axis, const point3& a, const point3& b,
                                         const point3& c) {
    return filter_sign<orient2d_polynomial>(projection(axis, a), projection(axis, b),
                                            projection(axis, c));
}

/// Stage 1 of `orient3d`.
[[nodiscard]] inline int orient3d_filter(const point3& a, const point3& b, const point3& c,
                                         const point3& d) {
    return filter_sign<orient3d_polynomial>(a, b, c, d);
}

/// Stage 1 of `collinear`: 0 if the points are certainly collinear, 1 if they certainly are not, or
/// `undecided`.
[[nodiscard]] inline int collinear_filter(const point3& a, const point3& b, const point3& c) {
    int result = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int sign = orient2d_filter(axis, a, b, c);
        if (sign == 1 || sign == -1) return 1;
        if (sign == undecided) result = undecided;
    }
    return result;
}

}  // namespace treeform::detail::exact
