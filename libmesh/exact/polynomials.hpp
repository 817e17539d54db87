#pragma once
/// \file
/// The polynomials of the predicates, each written once and evaluated over several number types:
/// doubles for the filter, integers for the exact stage, and types that count rounding errors,
/// bounds of values or zero factors.
///
/// A polynomial maps points to differences of points, and these to a value:
///   points            how many points it takes
///   degree            of the value in the differences
///   growth            |value| <= 2^growth * D^degree when no difference exceeds D in magnitude
///   roundings         K such that the value computed in floating point errs by no more than
///                     ((1 + u)^K - 1) times its permanent (see filter.hpp)
///   differences(p)    all that is ever subtracted from coordinates
///   value(d)          sums and products of these
/// `growth` and `roundings` are checked by tests/unit/exact_bounds_test.cpp.

#include <libmesh/exact/vectors.hpp>

#include <array>
#include <cstddef>

namespace treeform::detail::exact {

/// (b - a) x (c - a). Growth: two products.
struct orient2d_polynomial {
    static constexpr std::size_t points = 3;
    static constexpr int degree = 2;
    static constexpr int growth = 1;
    static constexpr int roundings = 4;
    template <class Number>
    using vector = vector2<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 2>& d) {
        return cross(d[0], d[1]);
    }
};

/// (b - a) x (c - a) in space, a vector: its components are the three projected orient2d.
struct normal_polynomial {
    static constexpr std::size_t points = 3;
    static constexpr int degree = 2;
    static constexpr int growth = 1;
    static constexpr int roundings = 4;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 2>& d) {
        return cross(d[0], d[1]);
    }
};

/// ((b - a) x (c - a)) . (d - a). Growth: a 3x3 determinant with entries in [-1, 1] is at most 4
/// (it is linear in each entry, so it is largest at entries of +-1, where it is a multiple of 4
/// and by Hadamard at most 3^(3/2) < 6).
struct orient3d_polynomial {
    static constexpr std::size_t points = 4;
    static constexpr int degree = 3;
    static constexpr int growth = 2;
    static constexpr int roundings = 8;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[3] - p[0]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 3>& d) {
        return dot(cross(d[0], d[1]), d[2]);
    }
};

/// (b - a) . (d - c). Growth: three products.
struct compare_along_polynomial {
    static constexpr std::size_t points = 4;
    static constexpr int degree = 2;
    static constexpr int growth = 2;
    static constexpr int roundings = 5;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[3] - p[2]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 2>& d) {
        return dot(d[0], d[1]);
    }
};

/// |a - b|^2 - |c - d|^2. Growth: each square is at most 3 D^2 and neither is negative.
struct compare_distance_polynomial {
    static constexpr std::size_t points = 4;
    static constexpr int degree = 2;
    static constexpr int growth = 2;
    static constexpr int roundings = 6;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[0] - p[1], p[2] - p[3]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 2>& d) {
        return dot(d[0], d[0]) - dot(d[1], d[1]);
    }
};

/// n . m of planes (a, b, c) and (d, e, f). Growth: linear in each component of each difference, so
/// largest where all are +-D; of these 2^12 values none exceeds 8 D^4 (exact_bounds_test).
struct normal_dot_polynomial {
    static constexpr std::size_t points = 6;
    static constexpr int degree = 4;
    static constexpr int growth = 3;
    static constexpr int roundings = 11;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 4>& d) {
        return dot(cross(d[0], d[1]), cross(d[2], d[3]));
    }
};

/// (n x m).z of planes (a, b, c) and (d, e, f). Growth: likewise, at most 8 D^4.
struct normal_cross_polynomial {
    static constexpr std::size_t points = 6;
    static constexpr int degree = 4;
    static constexpr int growth = 3;
    static constexpr int roundings = 10;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 4>& d) {
        const auto x = [&](std::size_t i) { return d[i].y * d[i + 1].z - d[i].z * d[i + 1].y; };
        const auto y = [&](std::size_t i) { return d[i].z * d[i + 1].x - d[i].x * d[i + 1].z; };
        return x(0) * y(2) - y(0) * x(2);
    }
};

/// (n x m) . (h - g) of planes (a, b, c) and (d, e, f). Growth: likewise, at most 12 D^5.
struct normal_turn_polynomial {
    static constexpr std::size_t points = 8;
    static constexpr int degree = 5;
    static constexpr int growth = 4;
    static constexpr int roundings = 14;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3], p[5] - p[3], p[7] - p[6]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 5>& d) {
        return dot(cross(cross(d[0], d[1]), cross(d[2], d[3])), d[4]);
    }
};

/// (n x m) . k of planes (a, b, c), (d, e, f) and (g, h, i). Growth: likewise, at most 16 D^6.
struct normal_determinant_polynomial {
    static constexpr std::size_t points = 9;
    static constexpr int degree = 6;
    static constexpr int growth = 4;
    static constexpr int roundings = 17;
    template <class Number>
    using vector = vector3<Number>;

    template <class Number>
    static constexpr auto differences(const std::array<vector<Number>, points>& p) {
        return std::array{p[1] - p[0], p[2] - p[0], p[4] - p[3],
                          p[5] - p[3], p[7] - p[6], p[8] - p[6]};
    }
    template <class Number>
    static constexpr auto value(const std::array<vector<Number>, 6>& d) {
        return dot(cross(cross(d[0], d[1]), cross(d[2], d[3])), cross(d[4], d[5]));
    }
};

}  // namespace treeform::detail::exact
