#pragma once
/// \file
/// Sides of faces, which also encode the orientation of faces at an edge.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::arrange {

/// Twice the face number, plus 1 for the back.
///
/// At an edge from a to b, a face is represented by the side that faces counter-clockwise about the
/// edge: the front if the face runs from a to b.
using face_side = std::uint32_t;

[[nodiscard]] inline face_side front_of(std::uint32_t face) { return 2 * face; }
[[nodiscard]] inline face_side behind(std::uint32_t face) { return 2 * face + 1; }
[[nodiscard]] inline face_side other_side(face_side side) { return side ^ 1U; }
[[nodiscard]] inline std::uint32_t face_of(face_side side) { return side >> 1; }
[[nodiscard]] inline bool is_behind(face_side side) { return (side & 1U) != 0; }

/// The plane of a face of `mesh`.
[[nodiscard]] inline plane_points plane_of(mesh_view mesh, std::uint32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

}  // namespace treeform::detail::arrange
