#pragma once
/// \file
/// Separates touching parts of a solid by a few steps of the coordinates.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>

namespace treeform::detail::repair {

struct detached {
    std::uint64_t moved = 0;        ///< number of moved vertices
    std::uint64_t touching = 0;     ///< vertices that still share their coordinates with another
    double max_displacement = 0.0;  ///< largest change of a coordinate
};

/// Moves vertices with equal coordinates apart, so that programs that join equal coordinates see a
/// manifold: each toward the inside of the solid behind its faces, by 32 steps of float32, or
/// another number of steps if that causes intersections. Moves are checked exactly; vertices that
/// cannot be moved are counted.
///
/// \param of    precision of the coordinates, before and after
/// \param limit largest change of a coordinate
/// \pre   a closed manifold by point numbers, whose faces meet only in common corners and edges
///        (`split_nonmanifold`)
/// \cost  O(V + F), plus `self_intersections` of the moved faces with all others, a few times
/// \same  on any number of threads
detached detach(mesh& solid, precision of, double limit);

}  // namespace treeform::detail::repair
