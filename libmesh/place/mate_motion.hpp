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
    /// From the nearest point of the mesh to that of the part; 0 when they meet, or are the same
    /// except for rounding.
    point3 motion{};
    /// How far along it the mesh goes: 1 except for the clearance and for rounding. Not beyond the
    /// exact time of contact, as `sweep_among` says.
    double time = 0.0;
    sweep_result met{};  ///< what stops it there; `at_start`: nearer than the clearance already
};

/// For a mesh of which is known how it lies to what is nearest to it: `parts` are those that may be
/// in the way.
///
/// \throws std::overflow_error where the way is beyond the range of doubles; `way_between` too
[[nodiscard]] TREEFORM_API mate_motion motion_to_mate(const mesh_measure& nearest, const shape& a,
                                                      std::span<const shape> parts,
                                                      const sweep_options& options = {});

/// From the nearest point of the one mesh to that of the other.
[[nodiscard]] TREEFORM_API point3 way_between(const mesh_measure& nearest);

}  // namespace treeform::detail::place
