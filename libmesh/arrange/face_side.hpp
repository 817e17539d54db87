#pragma once
/// \file
/// Sides of faces, which name also how faces lie at an edge.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::arrange {

/// Twice the face's number, plus 1 for the side behind it.
///
/// At an edge from a to b a face is named by its side that looks counter-clockwise about the edge:
/// the front where it runs from a to b, as its inside is then to the left.
using face_side = std::uint32_t;

[[nodiscard]] inline face_side front_of(std::uint32_t face) { return 2 * face; }
[[nodiscard]] inline face_side behind(std::uint32_t face) { return 2 * face + 1; }
[[nodiscard]] inline face_side other_side(face_side side) { return side ^ 1U; }
[[nodiscard]] inline std::uint32_t face_of(face_side side) { return side >> 1; }
[[nodiscard]] inline bool is_behind(face_side side) { return (side & 1U) != 0; }

/// The plane that a face of `mesh` lies in.
[[nodiscard]] inline plane_points plane_of(mesh_view mesh, std::uint32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

}  // namespace treeform::detail::arrange
