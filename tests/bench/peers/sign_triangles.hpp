#pragma once
/// \file
/// One triangle-triangle test with the arithmetic left open: what decides is where the signs of
/// determinants come from, and nothing else differs.

#include <libmesh/exact/stages.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform::bench {

/// Signs as computed in `Real`, from corners rounded to it. A determinant that is not beyond eps
/// times the extent of the pair to the power of its degree counts as zero; so eps is free of units,
/// which is more than most programs do.
template <class Real>
class rounded_signs {
  public:
    rounded_signs(const triangle3& a, const triangle3& b, double eps) {
        if (eps == 0.0) return;
        Real extent = 0;
        for (const triangle3* t : {&a, &b})
            for (const point3& p : *t)
                for (std::size_t k = 0; k < 3; ++k)
                    extent = std::max(
                        extent, std::abs(static_cast<Real>(p[k]) - static_cast<Real>(a[0][k])));
        flat_ = static_cast<Real>(eps) * extent * extent;
        solid_ = flat_ * extent;
    }

    /// Of (b - a) x (c - a) . (d - a).
    [[nodiscard]] int volume(const point3& a, const point3& b, const point3& c,
                             const point3& d) const {
        const vec u = minus(b, a), v = minus(c, a), w = minus(d, a);
        return sign((u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                        (u[0] * v[1] - u[1] * v[0]) * w[2],
                    solid_);
    }
    /// Of component `axis` of (b - a) x (c - a).
    [[nodiscard]] int area(std::size_t axis, const point3& a, const point3& b,
                           const point3& c) const {
        const vec u = minus(b, a), v = minus(c, a);
        const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
        return sign(u[i] * v[j] - u[j] * v[i], flat_);
    }

  private:
    using vec = std::array<Real, 3>;
    static vec minus(const point3& p, const point3& q) {
        return {static_cast<Real>(p.x) - static_cast<Real>(q.x),
                static_cast<Real>(p.y) - static_cast<Real>(q.y),
                static_cast<Real>(p.z) - static_cast<Real>(q.z)};
    }
    static int sign(Real value, Real zero) { return (value > zero) - (value < -zero); }

    Real flat_ = 0, solid_ = 0;
};

/// Signs by treeform's integers alone, its filter left out.
struct integer_signs {
    integer_signs(const triangle3&, const triangle3&, double) {}
    [[nodiscard]] static int volume(const point3& a, const point3& b, const point3& c,
                                    const point3& d) {
        return detail::exact::orient3d_exact(a, b, c, d, nullptr);
    }
    [[nodiscard]] static int area(std::size_t axis, const point3& a, const point3& b,
                                  const point3& c) {
        return detail::exact::orient2d_exact(static_cast<int>(axis), a, b, c, nullptr);
    }
};

/// Triangles in one plane: no edge of one has the other strictly outside.
template <class Signs>
[[nodiscard]] bool coplanar_triangles_meet(const triangle3& a, const triangle3& b,
                                           const Signs& signs) {
    std::size_t axis = 0;
    while (axis < 2 && signs.area(axis, a[0], a[1], a[2]) == 0) ++axis;
    const auto separates = [&](const triangle3& t, const triangle3& other) {
        const int turn = signs.area(axis, t[0], t[1], t[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto outside = [&](const point3& p) {
                return signs.area(axis, t[i], t[(i + 1) % 3], p) * turn < 0;
            };
            if (std::ranges::all_of(other, outside)) return true;
        }
        return false;
    };
    return !separates(a, b) && !separates(b, a);
}

/// Turns `t`, whose corners lie on sides `s` of a plane, so that its first corner is alone on its
/// side; true when that is the side below or the other two are above: then the plane is to be
/// turned over.
[[nodiscard]] inline bool turn_lone_first(triangle3& t, std::array<int, 3> s) {
    const auto lone = [&]() -> std::pair<std::size_t, bool> {
        for (std::size_t i = 0; i < 3; ++i) {
            const int own = s[i], next = s[(i + 1) % 3], last = s[(i + 2) % 3];
            if (own > 0 && next <= 0 && last <= 0) return {i, false};
            if (own < 0 && next >= 0 && last >= 0) return {i, true};
        }
        for (std::size_t i = 0; i < 3; ++i)  // the other two are strictly on one side
            if (s[i] == 0) return {i, s[(i + 1) % 3] > 0};
        return {0, false};
    }();
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(lone.first), t.end());
    return lone.second;
}

/// Whether the closed triangles have a common point, by the signs of at most eight determinants.
/// \source Devillers and Guigue, Faster Triangle-Triangle Intersection Tests, INRIA RR-4488 (2002)
template <class Signs>
[[nodiscard]] bool triangles_meet(triangle3 a, triangle3 b, double eps) {
    const Signs signs(a, b, eps);
    const auto sides = [&](const triangle3& plane, const triangle3& t) {
        return std::array{signs.volume(plane[0], plane[1], plane[2], t[0]),
                          signs.volume(plane[0], plane[1], plane[2], t[1]),
                          signs.volume(plane[0], plane[1], plane[2], t[2])};
    };
    const auto apart = [](const std::array<int, 3>& s) {
        return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
    };
    const std::array of_a = sides(b, a);
    if (apart(of_a)) return false;
    const std::array of_b = sides(a, b);
    if (apart(of_b)) return false;
    constexpr std::array flat{0, 0, 0};
    if (of_a == flat || of_b == flat) return coplanar_triangles_meet(a, b, signs);
    const bool turn_b = turn_lone_first(a, of_a);
    const bool turn_a = turn_lone_first(b, of_b);
    if (turn_b) std::swap(b[1], b[2]);
    if (turn_a) std::swap(a[1], a[2]);
    return signs.volume(a[0], a[1], b[0], b[1]) <= 0 && signs.volume(a[0], a[2], b[2], b[0]) <= 0;
}

}  // namespace treeform::bench
