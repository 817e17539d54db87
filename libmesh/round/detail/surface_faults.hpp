#pragma once
/// \file
/// What is wrong with a surface of which most faces are known to be sound.

#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/mesh.hpp>
#include <libtree/progress.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace tf::detail {

struct surface_faults {
    std::vector<std::uint32_t> degenerate;  ///< faces, ascending
    std::vector<face_pair> pairs;           ///< that meet beyond common corners and edges
    bool open = false;                      ///< an edge has faces that do not run both ways alike
    bool cancelled = false;
};

struct surface_check {
    /// [F], or empty where nothing is known: 1 for faces that have an area and that meet each
    /// other in common corners and edges only, as they are.
    std::span<const std::uint8_t> sound{};
    /// Whether edges count: then those at which all faces are sound are known to be closed.
    bool closed = true;
    progress_callback progress{};
};

/// Exact. All faces that are not sound are held against all faces, and the edges they are at are
/// looked at; nothing of what `sound` says is looked at again.
///
/// \pre  coordinates are finite, corners points
/// \cost as `self_intersections` of the faces that are not sound and those whose boxes meet
///       theirs, and a box query for each face
/// \same on any number of threads
[[nodiscard]] surface_faults find_faults(mesh_view surface, const surface_check& check);

}  // namespace tf::detail
