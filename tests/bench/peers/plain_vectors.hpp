#pragma once
/// \file
/// Vectors of any floating-point type, with nothing done about rounding.

#include <treeform/mesh/predicates.hpp>

#include <array>

namespace treeform::bench {

template <class Real>
struct plain_vectors {
    using vec = std::array<Real, 3>;
    using corners = std::array<vec, 3>;

    static vec vec_of(const point3& p) {
        return {static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)};
    }
    static corners corners_of(const triangle3& t) {
        return {vec_of(t[0]), vec_of(t[1]), vec_of(t[2])};
    }
    static vec minus(const vec& p, const vec& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
    static vec along(const vec& p, const vec& u, Real s) {
        return {p[0] + s * u[0], p[1] + s * u[1], p[2] + s * u[2]};
    }
    static Real dot(const vec& p, const vec& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
    static vec cross(const vec& p, const vec& q) {
        return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    }
};

}  // namespace treeform::bench
