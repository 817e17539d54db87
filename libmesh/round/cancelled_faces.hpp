#pragma once
/// \file
/// Removes faces that cover each other.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// [F] 1 for faces to remove, among faces with the same corners. For a solid, pairs of opposite
/// faces are removed, since they enclose no volume; the remaining ones have the same orientation.
/// Otherwise, all but the first are removed. The first ones are kept.
[[nodiscard]] std::vector<std::uint8_t> cancelled_faces(std::span<const face> faces, bool solid);

}  // namespace treeform::detail::round
