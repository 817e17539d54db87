#pragma once
/// \file
/// The polynomials of ray predicates (plane_predicates.hpp), in the form described in
/// polynomials.hpp.
///
/// A direction d is represented as a point, with the difference d - 0; the point 0, which is on
/// every lattice, is an additional argument.

#include <libmesh/exact/vectors.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::exact {

/// ((b - a) x (c - a)) . (d - 0). Growth: as orient3d.
struct direction_side_polynomial {
    static constexpr std::size_t points = 5;  // a, b, c, d, 0
    static constexpr int degree = 3;
    static constexpr int growth = 2;
    static constexpr int roundings = 8;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[3] - p[4]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 3>& d) {
        return dot(cross(d[0], d[1]), d[2]);
    }
};

/// (d - 0) x (p - o) in the plane. Growth: two products.
struct line_side_polynomial {
    static constexpr std::size_t points = 4;  // o, p, d, 0
    static constexpr int degree = 2;
    static constexpr int growth = 1;
    static constexpr int roundings = 4;
    template <class Number>
    using vector = vector2<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[2] - p[3], p[1] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 2>& d) {
        return cross(d[0], d[1]);
    }
};

/// n . (a - o) and n . d, whose quotient is the parameter of the cut with the plane through a.
/// Growth: as orient3d.
struct cut_polynomial {
    static constexpr std::size_t points =
        8;  // o, d, 0, then a plane: a, u_from, u_to, v_from, v_to
    static constexpr int degree = 3;
    static constexpr int growth = 2;
    static constexpr int roundings = 8;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[5] - p[4], p[7] - p[6], p[3] - p[0], p[1] - p[2]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 4>& d) {
        const auto n = cross(d[0], d[1]);
        return vector2<decltype(dot(n, d[2]))>{dot(n, d[2]), dot(n, d[3])};
    }
};

/// (n . (a - o)) 1 - (n . d) s. Growth: two products of two determinants' worth and one more.
struct compare_cut_polynomial {
    static constexpr std::size_t points = 9;  // those of cut_polynomial, then (s, 1, 0)
    static constexpr int degree = 4;
    static constexpr int growth = 3;
    static constexpr int roundings = 11;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[5] - p[4], p[7] - p[6], p[3] - p[0], p[1] - p[2], p[8] - p[2]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 5>& d) {
        const auto n = cross(d[0], d[1]);
        return dot(n, d[2]) * d[4].y - dot(n, d[3]) * d[4].x;
    }
};

/// (n . (a - o)) (m . d) - (m . (b - p)) (n . d). Growth: two products of two determinants.
struct compare_cuts_polynomial {
    static constexpr std::size_t points = 14;  // of cut_polynomial, then another plane, and p
    static constexpr int degree = 6;
    static constexpr int growth = 5;
    static constexpr int roundings = 18;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[5] - p[4],   p[7] - p[6],  p[3] - p[0], p[10] - p[9],
                          p[12] - p[11], p[8] - p[13], p[1] - p[2]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 7>& d) {
        const auto n = cross(d[0], d[1]);
        const auto m = cross(d[3], d[4]);
        return dot(n, d[2]) * dot(m, d[6]) - dot(m, d[5]) * dot(n, d[6]);
    }
};

}  // namespace treeform::detail::exact
