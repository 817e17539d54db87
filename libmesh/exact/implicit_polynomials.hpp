#pragma once
/// \file
/// The coordinates of constructed points as quotients of polynomials, in the form described in
/// polynomials.hpp. They are evaluated over doubles, for an approximation and its error bound, and
/// over numbers of any size, so that no fixed width depends on their growth.

#include <libmesh/exact/vectors.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::exact {

/// x / y is the parameter t with a + t (b - a) on the line through c, d.
struct lines_polynomial {
    static constexpr std::size_t points = 4;  // a, b, c, d, projected
    static constexpr int degree = 2;
    static constexpr int roundings = 4;
    template <class Number>
    using vector = vector2<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[3] - p[2], p[2] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 3>& d) {
        return vector2<decltype(cross(d[0], d[1]))>{cross(d[2], d[1]), cross(d[0], d[1])};
    }
};

/// x / y is the parameter t with a + t (b - a) in the plane c, d, e.
struct line_plane_polynomial {
    static constexpr std::size_t points = 5;  // a, b, c, d, e
    static constexpr int degree = 3;
    static constexpr int roundings = 8;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[3] - p[2], p[4] - p[2], p[2] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 4>& d) {
        const auto n = cross(d[1], d[2]);
        return vector2<decltype(dot(n, d[0]))>{dot(n, d[3]), dot(n, d[0])};
    }
};

/// x / y is the parameter t with a + t (b - a) in the plane through `at` with the normal n, the
/// vector from the origin to the last point.
struct line_normal_polynomial {
    static constexpr std::size_t points = 5;  // a, b, at, the origin, n
    static constexpr int degree = 2;
    static constexpr int roundings = 5;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 3>& d) {
        return vector2<decltype(dot(d[2], d[0]))>{dot(d[2], d[1]), dot(d[2], d[0])};
    }
};

/// A vector over a common denominator.
template <class Over, class Under>
struct quotient_point {
    vector3<Over> over;
    Under under;
};

/// The vector from a to the intersection of the planes (a, b, c), (d, e, f) and (g, h, i). With
/// their normals n, m, k and p = m . (d - a), q = k . (g - a), it is (p (k x n) + q (n x m)) / (n .
/// (m x k)).
struct planes_polynomial {
    static constexpr std::size_t points = 9;
    static constexpr int degree = 7;
    static constexpr int roundings = 20;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3],
                          p[7] - p[6], p[8] - p[6], p[3] - p[0], p[6] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 8>& d) {
        const auto n = cross(d[0], d[1]);
        const auto m = cross(d[2], d[3]);
        const auto k = cross(d[4], d[5]);
        const auto p = dot(m, d[6]);
        const auto q = dot(k, d[7]);
        const auto kn = cross(k, n);
        const auto nm = cross(n, m);
        return quotient_point<decltype(p * kn.x + q * nm.x), decltype(dot(cross(m, k), n))>{
            {p * kn.x + q * nm.x, p * kn.y + q * nm.y, p * kn.z + q * nm.z}, dot(cross(m, k), n)};
    }
};

}  // namespace treeform::detail::exact
