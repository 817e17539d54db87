#pragma once
/// \file
/// Points in rational numbers, and the volumes of meshes.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <gmpxx.h>

#include <array>

namespace test {

using rational_point = std::array<mpq_class, 3>;

inline rational_point rational(const tf::point3& p) { return {p.x, p.y, p.z}; }

inline rational_point minus(const rational_point& p, const rational_point& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
inline rational_point cross(const rational_point& p, const rational_point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
inline mpq_class dot(const rational_point& p, const rational_point& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
inline rational_point along(const rational_point& p, const rational_point& q, const mpq_class& t) {
    const rational_point d = minus(q, p);
    return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

/// Six times the signed volume under a triangle.
inline mpq_class under(const rational_point& a, const rational_point& b, const rational_point& c) {
    return dot(a, cross(b, c));
}

inline mpq_class volume_of(const tf::mesh& mesh) {
    mpq_class sum = 0;
    for (const tf::face& f : mesh.faces)
        sum += under(rational(mesh.points[f[0]]), rational(mesh.points[f[1]]),
                     rational(mesh.points[f[2]]));
    return sum / 6;
}

}  // namespace test
