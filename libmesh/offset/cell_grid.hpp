#pragma once
/// \file
/// Cubes that the points at a distance from a mesh are in.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::base {
class work_progress;
}

namespace treeform::detail::offset {

/// Points on whole numbers of steps, 20 bits an axis.
using lattice_key = std::uint64_t;

enum class wanted_side : std::uint8_t { inside, outside, any };

/// Cubes of one size on a lattice, by their lowest corners, which ascend.
struct cell_grid {
    point3 low{};
    double step = 0.0;
    std::vector<lattice_key> cells{};

    [[nodiscard]] static lattice_key key_of(const std::array<std::uint32_t, 3>& at) {
        return lattice_key{at[0]} << 40 | lattice_key{at[1]} << 20 | lattice_key{at[2]};
    }
    /// The corner of a cube, its coordinates one up along the axes of the bits of `corner`.
    [[nodiscard]] static lattice_key corner_of(lattice_key cell, unsigned corner) {
        return cell + (lattice_key{corner & 1} << 40) + (lattice_key{corner >> 1 & 1} << 20) +
               lattice_key{corner >> 2 & 1};
    }
    /// Of points equal along an axis, equal coordinates.
    [[nodiscard]] point3 point(lattice_key at, double shift = 0.0) const;
};

/// The cubes that may hold points at `distance` from the mesh on that side of it, all of them: a
/// cube is left out where its center is too near or too far. None of them meets the mesh. Empty
/// where `progress` is cancelled.
///
/// \pre    step <= distance / 2; the mesh is closed, unless any side will do
/// \throws std::invalid_argument, in the name of the function, where there would be too many
[[nodiscard]] cell_grid cells_at(const char* function, const prepared_mesh& mesh, double distance,
                                 wanted_side side, double step, base::work_progress& progress);

}  // namespace treeform::detail::offset
