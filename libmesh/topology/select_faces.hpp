#pragma once
/// \file
/// Extracts faces of a mesh.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>

namespace treeform {

/// A mesh with the given faces, in the order of `faces`, and the points that they use, in the order
/// of `mesh`.
///
/// \throws std::invalid_argument naming a number that is not a face of the mesh, or a face with a
///         corner out of range
/// \cost   O(V + F) time
/// \same   on any number of threads
[[nodiscard]] mesh select_faces(const mesh_ref& mesh, std::span<const std::uint32_t> faces);

}  // namespace treeform
