#pragma once
/// \file
/// Solids that touch themselves, moved apart by a few steps of the coordinates.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

struct detached {
    std::uint64_t moved = 0;        ///< vertices
    std::uint64_t touching = 0;     ///< vertices that still share their coordinates with another
    double max_displacement = 0.0;  ///< of a coordinate
};

/// Moves vertices with equal coordinates apart, by 32 steps of float32 or, where that breaks
/// something, by some other number of steps, each towards the inside of the solid behind its
/// faces, so that programs which join equal coordinates see a manifold. What is moved is checked
/// exactly; what would break is left, and counted.
///
/// \param of    precision of the coordinates, before and after
/// \param limit the furthest that a coordinate may move
/// \pre   a closed manifold by numbers, of which no two faces meet (`split_nonmanifold`)
/// \cost  O(V + F), and as `self_intersections` of the faces moved against all others, a few times
/// \same  on any number of threads
detached detach(mesh& solid, precision of, double limit);

}  // namespace treeform::detail::repair
