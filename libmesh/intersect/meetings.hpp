#pragma once
/// \file
/// The intersections of pairs of faces, with points identified by the input elements that define
/// them.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::intersect {

/// An edge as its points, the lower first.
using edge_name = std::array<std::uint32_t, 2>;

[[nodiscard]] inline edge_name edge_between(std::uint32_t u, std::uint32_t v) {
    return u < v ? edge_name{u, v} : edge_name{v, u};
}
/// Edge i of a face, from corner i to the next.
[[nodiscard]] inline edge_name edge_of(const face& f, std::size_t i) {
    return edge_between(f[i], f[i == 2 ? 0 : i + 1]);
}

/// The definition of an intersection point of two faces, by numbers of points and faces. Equal
/// names are equal points; different names may also be equal points.
struct point_name {
    enum class origin : std::uint8_t { edges, edge_face };
    origin kind = origin::edges;
    edge_name edge{};                   ///< for two edges, the lower one
    std::array<std::uint32_t, 2> by{};  ///< the other edge, or a face and 0
    friend auto operator<=>(const point_name&, const point_name&) = default;
};

/// An end of the intersection of two faces.
struct meeting_end {
    std::uint32_t point = 0;  ///< point of the input, or V + the number of a name
    triangle_feature on_a = triangle_feature::v0;
    triangle_feature on_b = triangle_feature::v0;
};

struct meeting {
    std::uint32_t a = 0;  ///< faces, the lower number first
    std::uint32_t b = 0;
    bool coplanar = false;
    std::uint8_t count = 0;
    std::array<meeting_end, 6> ends{};
};

struct mesh_meetings {
    std::vector<meeting> meetings;       ///< in the order of the pairs
    std::vector<point_name> names;       ///< ascending, all different
    std::vector<implicit_point> points;  ///< point of each name
};

/// Computes the intersection of each pair, and names its points. Pairs of kind `degenerate` get no
/// points.
/// \pre the faces of all other pairs are not degenerate
[[nodiscard]] mesh_meetings meetings_of(mesh_view mesh, std::span<const face_pair> pairs);

/// A box around the intersection of two faces. \pre they meet, and are not degenerate
[[nodiscard]] aabb<double, 3> box_of_meeting(mesh_view mesh, const face_pair& pair);

}  // namespace treeform::detail::intersect
