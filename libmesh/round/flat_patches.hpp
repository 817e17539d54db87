#pragma once
/// \file
/// Which faces next to each other lie in one plane, nearly.

#include <libmesh/round/joint_geometry.hpp>
#include <libmesh/round/snap_nearby.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

/// Faces of a surface, some of which are chosen.
struct chosen_faces {
    mesh_view surface;
    std::span<const std::uint8_t> chosen;    ///< [F]
    std::span<const std::uint32_t> face_of;  ///< [F] face that `how` knows each one by
    const joint& how;
};

/// Chosen faces that are flat with their neighbors, by patches; and the edges that are not between
/// two of one patch, ascending.
struct flat_patches {
    std::vector<std::array<std::uint32_t, 2>> by_patch;  ///< patch, face
    std::vector<edge_name> borders;
};

/// Flat are neighbors of one source, and those that are in one plane except for `near`, facing the
/// same way; all of one operand.
[[nodiscard]] flat_patches find_flat_patches(const chosen_faces& of, double near);

}  // namespace treeform::detail::round
