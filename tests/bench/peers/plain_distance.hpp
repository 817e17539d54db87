#pragma once
/// \file
/// Distances of points and triangles as textbooks write them, in any floating-point type: regions
/// by the signs of products, quotients without care for what is nearly parallel or thin.

#include "bench/peers/plain_vectors.hpp"
#include "bench/peers/sign_triangles.hpp"
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace treeform::bench {

template <class Real>
class plain_distance : plain_vectors<Real> {
  public:
    /// From a point to a closed triangle.
    /// \source Ericson, Real-Time Collision Detection (2005), 5.1.5
    [[nodiscard]] static double point_triangle(const point3& query, const triangle3& triangle) {
        return static_cast<double>(std::sqrt(squared(vec_of(query), corners_of(triangle))));
    }

    /// Between closed triangles: 0 where the rounded test says that they meet, else the least of
    /// six corners against triangles and nine pairs of edges.
    [[nodiscard]] static double triangle_triangle(const triangle3& a, const triangle3& b) {
        if (triangles_meet<rounded_signs<Real>>(a, b, 0.0)) return 0.0;
        const corners p = corners_of(a), q = corners_of(b);
        Real least = std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < 3; ++i) {
            least = std::min({least, squared(p[i], q), squared(q[i], p)});
            for (std::size_t j = 0; j < 3; ++j)
                least = std::min(least, edges(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]));
        }
        return static_cast<double>(std::sqrt(least));
    }

  private:
    using typename plain_vectors<Real>::vec, typename plain_vectors<Real>::corners;
    using plain_vectors<Real>::vec_of, plain_vectors<Real>::corners_of, plain_vectors<Real>::minus;
    using plain_vectors<Real>::along, plain_vectors<Real>::dot;

    static Real between(const vec& p, const vec& q) {
        const vec d = minus(p, q);
        return dot(d, d);
    }

    static Real squared(const vec& p, const corners& t) {
        const vec ab = minus(t[1], t[0]), ac = minus(t[2], t[0]), ap = minus(p, t[0]);
        const Real d1 = dot(ab, ap), d2 = dot(ac, ap);
        if (d1 <= 0 && d2 <= 0) return between(p, t[0]);
        const vec bp = minus(p, t[1]);
        const Real d3 = dot(ab, bp), d4 = dot(ac, bp);
        if (d3 >= 0 && d4 <= d3) return between(p, t[1]);
        const Real vc = d1 * d4 - d3 * d2;
        if (vc <= 0 && d1 >= 0 && d3 <= 0) return between(p, along(t[0], ab, d1 / (d1 - d3)));
        const vec cp = minus(p, t[2]);
        const Real d5 = dot(ab, cp), d6 = dot(ac, cp);
        if (d6 >= 0 && d5 <= d6) return between(p, t[2]);
        const Real vb = d5 * d2 - d1 * d6;
        if (vb <= 0 && d2 >= 0 && d6 <= 0) return between(p, along(t[0], ac, d2 / (d2 - d6)));
        const Real va = d3 * d6 - d5 * d4;
        if (va <= 0 && d4 >= d3 && d5 >= d6)
            return between(p, along(t[1], minus(t[2], t[1]), (d4 - d3) / ((d4 - d3) + (d5 - d6))));
        const Real scale = 1 / (va + vb + vc);
        return between(p, along(along(t[0], ab, vb * scale), ac, vc * scale));
    }

    static Real edges(const vec& p, const vec& p_end, const vec& q, const vec& q_end) {
        const vec u = minus(p_end, p), v = minus(q_end, q), r = minus(p, q);
        const Real uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
        const Real parallel = uu * vv - uv * uv;
        const auto clamped = [](Real x) { return std::clamp(x, Real(0), Real(1)); };
        Real s = parallel > 0 ? clamped((uv * vr - ur * vv) / parallel) : Real(0);
        const Real t = vv > 0 ? clamped((uv * s + vr) / vv) : Real(0);
        if (uu > 0) s = clamped((uv * t - ur) / uu);
        return between(along(p, u, s), along(q, v, t));
    }
};

}  // namespace treeform::bench
