#pragma once
/// \file
/// A part of a mesh as a mesh of its own.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <span>

namespace treeform {

/// The faces numbered in `faces`, in that order, and the points they use, in the order they have
/// in `mesh`.
///
/// \pre  every number is less than `mesh.faces.size()`
/// \cost O(V + F) time
/// \same on any number of threads
[[nodiscard]] TREEFORM_API mesh select_faces(mesh_view mesh, std::span<const std::uint32_t> faces);

}  // namespace treeform
