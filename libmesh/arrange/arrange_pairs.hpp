#pragma once
/// \file
/// The arrangement of faces whose intersecting pairs are known.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// As `arrange_faces`, with known `pairs` of faces that meet beyond shared corners, and known
/// `degenerate` faces, which are in no pair; both ascending.
[[nodiscard]] arrange_faces_result arrange_pairs(mesh_view mesh, std::span<const face_pair> pairs,
                                                 std::vector<std::uint32_t> degenerate,
                                                 const progress_callback& progress);

}  // namespace treeform::detail::arrange
