#pragma once
/// \file
/// What is wrong with a surface of which most faces are certified: known to meet others in common
/// corners and edges only.

#include <libmesh/round/turned_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct surface_faults {
    std::vector<std::uint32_t> degenerate;  ///< faces, ascending
    std::vector<face_pair> pairs;           ///< that meet beyond common corners and edges
    std::vector<std::uint32_t> turned;  ///< where nothing else is wrong: faces that do not bound
                                        ///< the solid from outside, ascending
    bool open = false;                  ///< an edge has faces that do not run both ways alike
    bool cancelled = false;
};

struct surface_check {
    /// [F], or empty where nothing is known: 1 for faces that have an area and that meet each
    /// other in common corners and edges only, as they are.
    std::span<const std::uint8_t> certified{};
    /// Whether the surface is to bound a solid: then edges count, those at which all faces are
    /// certified being known to be closed, and which side is inside.
    bool solid = true;
    /// How far, at most, rounding has moved points of faces that are not certified, in each
    /// coordinate, from where all faces had the inside behind them; infinite where points have
    /// become one.
    double moved = std::numeric_limits<double>::infinity();
    winding_of_rest rest{};  ///< where more faces bound the solid, at edges of certified ones
    progress_callback progress{};
};

/// Exact. All faces that are not certified are held against all faces, and the edges they are at
/// are looked at; nothing of what `certified` says is looked at again. Parts of which all may have
/// been turned are (`find_turned_faces`).
///
/// \pre  coordinates are finite, corners points
/// \cost as `self_intersections` of the faces that are not certified and those whose boxes meet
///       theirs, and a box query for each face; as `find_turned_faces`
/// \same on any number of threads
[[nodiscard]] surface_faults find_faults(mesh_view surface, const surface_check& check);

}  // namespace treeform::detail::round
