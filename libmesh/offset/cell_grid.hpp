#pragma once
/// \file
/// Cubes around the points at a given distance from a mesh.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::base {
class work_progress;
}

namespace treeform::detail::offset {

/// The integer coordinates of a lattice point, 20 bits for each axis.
using lattice_key = std::uint64_t;

enum class wanted_side : std::uint8_t { inside, outside, any };

/// Cubes of one size on a lattice, given by their lowest corners, ascending.
struct cell_grid {
    point3 low{};
    double step = 0.0;
    std::vector<lattice_key> cells{};

    [[nodiscard]] static lattice_key key_of(const std::array<std::uint32_t, 3>& at) {
        return lattice_key{at[0]} << 40 | lattice_key{at[1]} << 20 | lattice_key{at[2]};
    }
    /// A corner of a cube: bits 0, 1 and 2 of `corner` add one step along x, y and z.
    [[nodiscard]] static lattice_key corner_of(lattice_key cell, unsigned corner) {
        return cell + (lattice_key{corner & 1} << 40) + (lattice_key{corner >> 1 & 1} << 20) +
               lattice_key{corner >> 2 & 1};
    }
    /// The position of a lattice point. Points that are equal along an axis get equal coordinates.
    [[nodiscard]] point3 point(lattice_key at, double shift = 0.0) const;
};

/// All cubes that may contain points at `distance` from the mesh on the given side; cubes whose
/// center is too near or too far are excluded. No cube meets the mesh. Empty when `progress` is
/// cancelled.
///
/// \pre    step <= distance / 2; the mesh is closed, unless `side` is `any`
/// \throws std::invalid_argument, naming `function`, when there are too many cubes
[[nodiscard]] cell_grid cells_at(const char* function, const prepared_mesh& mesh, double distance,
                                 wanted_side side, double step, base::work_progress& progress);

}  // namespace treeform::detail::offset
