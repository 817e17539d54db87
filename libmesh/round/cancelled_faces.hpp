#pragma once
/// \file
/// Faces that cover each other.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// [F] Which faces go, of those with the same corners: of a solid, they go in pairs back to back,
/// since these bound nothing between them, so that the others face the same way; else all but the
/// first go. The first ones stay.
[[nodiscard]] std::vector<std::uint8_t> cancelled_faces(std::span<const face> faces, bool solid);

}  // namespace treeform::detail::round
