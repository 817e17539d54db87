#pragma once
/// \file
/// Removes faces that cover each other.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// [F] 1 for faces to remove, of those with the same corners. For a solid, pairs of opposite faces
/// are removed, since there is nothing between them, so that the remaining ones have the same
/// orientation. Otherwise, all but the first are removed. The first ones stay.
[[nodiscard]] std::vector<std::uint8_t> cancelled_faces(std::span<const face> faces, bool solid);

}  // namespace treeform::detail::round
