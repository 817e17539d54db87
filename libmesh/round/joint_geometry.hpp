#pragma once
/// \file
/// Edges by name, and what is computed of them in double.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace treeform::detail::round {

using edge_name = std::array<std::uint32_t, 2>;  ///< the lower end first

inline edge_name edge_between(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

inline std::array<edge_name, 3> edges_of(const face& f) {
    return {edge_between(f[0], f[1]), edge_between(f[1], f[2]), edge_between(f[2], f[0])};
}

inline bool holds(const face& f, std::uint32_t p) { return f[0] == p || f[1] == p || f[2] == p; }

inline double length(const point3& v) { return std::sqrt(base::dot(v, v)); }

/// Around the edge from p to q, and what is nearer to it than `by`.
inline aabb<double, 3> box_around(const point3& p, const point3& q, double by) {
    return {{std::min(p.x, q.x) - by, std::min(p.y, q.y) - by, std::min(p.z, q.z) - by},
            {std::max(p.x, q.x) + by, std::max(p.y, q.y) + by, std::max(p.z, q.z) + by}};
}

}  // namespace treeform::detail::round
