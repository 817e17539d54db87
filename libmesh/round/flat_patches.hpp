#pragma once
/// \file
/// Faces next to each other that lie in one plane, except for what is near it.

#include <libmesh/round/joint_geometry.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct patch_inputs {
    mesh_view surface{};
    std::span<const std::uint8_t> offending{};  ///< [F]
    std::span<const std::uint32_t> face_of{};   ///< [F] number of each face in the next two
    std::span<const std::uint32_t> source{};    ///< those of the same number lie in one plane
    std::span<const std::uint32_t> operand{};   ///< or empty; no patch has faces of several
    double near = 0.0;                          ///< how far from a plane is still flat
};

struct flat_patches {
    std::vector<std::array<std::uint32_t, 2>> by_patch;  ///< patch, face; ascending
    std::vector<edge_name> borders;  ///< edges that are not between two faces of a patch, ascending
};

/// Offending faces that are flat with their neighbors, by patches.
[[nodiscard]] flat_patches find_flat_patches(const patch_inputs& in);

}  // namespace treeform::detail::round
