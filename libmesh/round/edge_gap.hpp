#pragma once
/// \file
/// The gap between edges that pass each other.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace treeform::detail::round {

/// The shortest segment between two edges, if it ends inside both.
struct edge_gap {
    double length;
    point3 middle;
};

/// \return none if the shortest segment is at an end of an edge, or the edges are parallel
[[nodiscard]] inline std::optional<edge_gap> gap_between(const std::array<point3, 2>& s,
                                                         const std::array<point3, 2>& t) {
    const point3 u = base::minus(s[1], s[0]), v = base::minus(t[1], t[0]),
                 w = base::minus(t[0], s[0]);
    const point3 normal = base::cross(u, v);
    const double square = base::dot(normal, normal);
    const double along_u = base::dot(base::cross(w, v), normal),
                 along_v = base::dot(base::cross(w, u), normal);
    if (!(along_u > 0.0 && along_u < square && along_v > 0.0 && along_v < square))
        return std::nullopt;
    const point3 on_s = base::plus(s[0], base::scaled(u, along_u / square)),
                 on_t = base::plus(t[0], base::scaled(v, along_v / square));
    return edge_gap{std::abs(base::dot(w, normal)) / std::sqrt(square),
                    base::scaled(base::plus(on_s, on_t), 0.5)};
}

}  // namespace treeform::detail::round
