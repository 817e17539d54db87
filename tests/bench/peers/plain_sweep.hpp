#pragma once
/// \file
/// The first contact of triangles in straight motion, in floating point: by the formula, and by
/// advancing as far as the distance allows.

#include "bench/peers/plain_distance.hpp"
#include "bench/peers/plain_vectors.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace treeform::bench {

/// The least t in [0, 1] at which a corner meets a face or two edges meet, each by one quotient of
/// determinants in `Real`; what is parallel to the motion is passed over.
template <class Real>
class plain_sweep : plain_vectors<Real> {
  public:
    [[nodiscard]] static std::optional<double> first_contact(const triangle3& a, const triangle3& b,
                                                             const point3& d) {
        const corners p = corners_of(a), q = corners_of(b);
        const vec u = vec_of(d), back{-u[0], -u[1], -u[2]};
        std::optional<Real> first;
        const auto offer = [&](std::optional<Real> t) {
            if (t && *t >= 0 && *t <= 1 && (!first || *t < *first)) first = t;
        };
        for (std::size_t i = 0; i < 3; ++i) {
            offer(corner(p[i], u, q));
            offer(corner(q[i], back, p));
            for (std::size_t j = 0; j < 3; ++j)
                offer(edges(p[i], p[(i + 1) % 3], u, q[j], q[(j + 1) % 3]));
        }
        return first ? std::optional(static_cast<double>(*first)) : std::nullopt;
    }

  private:
    using typename plain_vectors<Real>::vec, typename plain_vectors<Real>::corners;
    using plain_vectors<Real>::vec_of, plain_vectors<Real>::corners_of, plain_vectors<Real>::minus;
    using plain_vectors<Real>::dot, plain_vectors<Real>::cross;

    /// p + t u = q0 + v e + w f with v, w >= 0 and v + w <= 1.
    static std::optional<Real> corner(const vec& p, const vec& u, const corners& q) {
        const vec e = minus(q[1], q[0]), f = minus(q[2], q[0]), r = minus(p, q[0]);
        const vec n = cross(e, f);
        const Real det = -dot(u, n);
        if (det == 0) return {};
        const vec ru = cross(r, u);
        const Real v = dot(f, ru) / det, w = -dot(e, ru) / det;
        if (!(v >= 0 && w >= 0 && v + w <= 1)) return {};
        return dot(r, n) / det;
    }
    /// p + s (p2 - p) + t u = q + w (q2 - q) with s, w in [0, 1].
    static std::optional<Real> edges(const vec& p, const vec& p2, const vec& u, const vec& q,
                                     const vec& q2) {
        const vec e = minus(p2, p), f = minus(q2, q), r = minus(q, p);
        const vec n = cross(e, f);
        const Real det = dot(u, n);
        if (det == 0) return {};
        const Real s = dot(r, cross(f, u)) / dot(e, cross(f, u));
        const Real w = dot(r, cross(e, u)) / -dot(f, cross(e, u));
        if (!(s >= 0 && s <= 1 && w >= 0 && w <= 1)) return {};
        return dot(r, n) / det;
    }
};

/// Conservative advancement in double: on by the distance over the speed, until the distance is
/// within `near` of the size of the pair, or 100 steps are gone.
[[nodiscard]] inline std::optional<double> advanced_to_contact(triangle3 a, const triangle3& b,
                                                               const point3& d, double near) {
    double size = 0;
    for (const point3& p : b)
        size = std::max(size, std::hypot(p.x - b[0].x, p.y - b[0].y, p.z - b[0].z));
    const double speed = std::hypot(d.x, d.y, d.z);
    const triangle3 start = a;
    double time = 0;
    for (int step = 0; step < 100; ++step) {
        const double distance = plain_distance<double>::triangle_triangle(a, b);
        if (!(distance > near * size)) return time;
        time += distance / speed;
        if (time > 1) return {};
        for (std::size_t i = 0; i < 3; ++i)
            a[i] = {start[i].x + time * d.x, start[i].y + time * d.y, start[i].z + time * d.z};
    }
    return time;
}

}  // namespace treeform::bench
