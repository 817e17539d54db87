#pragma once
/// \file
/// Making another model of a given one: larger, or turned.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::bench {

/// `base` with at least `triangles` triangles (at most two more), or `base` itself when it has
/// them.
///
/// Every edge is cut in its middle, one triangle becoming four, as long as the result is not too
/// large; then only the longest edges are, so that the size comes out right. New points are moved
/// along their normal by up to 1e-4 of the length of their edge, so that the triangles of one old
/// face are not coplanar; where that would make faces meet, they stay in the middle.
///
/// \throws std::runtime_error when faces of the result meet even so
/// \same   on any machine, for a seed
[[nodiscard]] tf::mesh refined(const tf::mesh& base, std::size_t triangles, std::uint64_t seed);

/// About the center of its box, by an angle in radians about the box's shortest axis.
[[nodiscard]] tf::mesh turned(tf::mesh m, double angle);

}  // namespace treeform::bench
