#pragma once
/// \file
/// Where pairs of faces meet, every point named by the input it comes from.

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

/// An edge by its points, the lower first.
using edge_name = std::array<std::uint32_t, 2>;

[[nodiscard]] inline edge_name edge_between(std::uint32_t u, std::uint32_t v) {
    return u < v ? edge_name{u, v} : edge_name{v, u};
}
/// Edge i of a face, from corner i to the next.
[[nodiscard]] inline edge_name edge_of(const face& f, std::size_t i) {
    return edge_between(f[i], f[i == 2 ? 0 : i + 1]);
}

/// What a point of two faces is, by the numbers of points and faces. Equal names are equal points;
/// different ones may be, too.
struct point_name {
    enum class origin : std::uint8_t { edges, edge_face };
    origin kind = origin::edges;
    edge_name edge{};                   ///< of two edges, the lower one
    std::array<std::uint32_t, 2> by{};  ///< the other edge, or a face and 0
    friend auto operator<=>(const point_name&, const point_name&) = default;
};

/// An end of what two faces have in common.
struct meeting_end {
    std::uint32_t point = 0;  ///< of the input, or [V] + a name's number
    feature on_a = feature::v0;
    feature on_b = feature::v0;
};

struct meeting {
    std::uint32_t a = 0;  ///< faces, the lower number first
    std::uint32_t b = 0;
    bool coplanar = false;
    std::uint8_t count = 0;
    std::array<meeting_end, 6> ends{};
};

struct mesh_meetings {
    std::vector<meeting> meetings;       ///< as the pairs
    std::vector<point_name> names;       ///< ascending; all are different
    std::vector<implicit_point> points;  ///< of each name
};

/// Looks at the pairs once more, and names what they have in common.
/// \pre the faces of `pairs` are not degenerate
[[nodiscard]] mesh_meetings meetings_of(mesh_view mesh, std::span<const face_pair> pairs);

/// A box around what two faces have in common. \pre they meet, and are not degenerate
[[nodiscard]] aabb<double, 3> box_of_meeting(mesh_view mesh, const face_pair& pair);

}  // namespace treeform::detail::intersect
