#pragma once
/// \file
/// Proof that a triangle is within a distance of others.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace treeform::detail::simplify {

struct covering {
    bool proven = false;
    double at_most = 0.0;             ///< no point of the triangle is further away
    std::vector<std::uint32_t> used;  ///< triangles that the proof needs, ascending
};

/// Cuts `t` into pieces, each of which is within `distance` of a single triangle: as distance from
/// a convex set is convex, corners of a piece tell. Not proven: further away, or too many pieces.
[[nodiscard]] covering cover(const triangle3& t, std::span<const triangle3> by, double distance);

}  // namespace treeform::detail::simplify
