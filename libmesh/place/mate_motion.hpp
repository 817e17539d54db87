#pragma once
/// \file
/// The translation that brings the nearest points of two meshes together.

#include <libmesh/place/shape.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <span>

namespace treeform::detail::place {

struct mate_motion {
    /// From the nearest point of the mesh to the nearest point of the part; 0 when these meet, or
    /// are equal up to rounding.
    point3 motion{};
    /// The fraction of `motion` that the mesh moves: 1 except for the clearance and for rounding.
    /// Not beyond the exact time of contact, as in `sweep_among`.
    double time = 0.0;
    sweep_result met{};  ///< what stops the mesh; `at_start`: it starts nearer than the clearance
};

/// Computes the motion from `nearest`, the known relation of `a` to its nearest mesh; `parts` are
/// the meshes that may be in the way.
///
/// \throws std::overflow_error when the motion is beyond the range of doubles; also by
///         `way_between`
[[nodiscard]] TREEFORM_API mate_motion motion_to_mate(const mesh_measure& nearest, const shape& a,
                                                      std::span<const shape> parts,
                                                      const sweep_options& options = {});

/// The vector from the nearest point of the first mesh to the nearest point of the second.
[[nodiscard]] TREEFORM_API point3 way_between(const mesh_measure& nearest);

}  // namespace treeform::detail::place
