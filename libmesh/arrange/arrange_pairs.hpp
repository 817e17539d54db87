#pragma once
/// \file
/// The arrangement of faces of which something is known.

#include <libmesh/arrange/mesh_arrangement.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::arrange {

/// As `arrange_faces`, where the pairs of faces that meet beyond their shared corners are known,
/// and so are the faces without an area, which are in no pair; both ascending.
[[nodiscard]] arrange_faces_result arrange_pairs(mesh_view mesh, std::span<const face_pair> pairs,
                                                 std::vector<std::uint32_t> degenerate,
                                                 const progress_callback& progress);

/// Whether `arrange_faces` refuses none of the corners and leaves none of the faces out.
/// \pre  every corner is a point
/// \same on any number of threads
[[nodiscard]] bool can_all_be_arranged(mesh_view mesh);

/// As `arrange_faces` of such faces, but without the `given_points`; `tree` is that of the faces,
/// and is gone when their pairs have been found.
[[nodiscard]] arrange_faces_result arrange_by_tree(mesh_view mesh, tree<3> tree,
                                                   const progress_callback& progress);

/// As `arrange_faces`, but without the `given_points`: for those who can move theirs there.
[[nodiscard]] arrange_faces_result arrange_without_points(mesh_view mesh,
                                                          const arrange_faces_options& options);

}  // namespace treeform::detail::arrange
