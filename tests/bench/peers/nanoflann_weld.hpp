#pragma once
/// \file
/// Welding with the kd-tree of nanoflann, as its users write it.

#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::bench {

/// [V] The point that each becomes by the rule `first`: in file order, one that is not dropped yet
/// is kept, and a radius search about it drops the later ones, each to the nearest so far.
[[nodiscard]] std::vector<std::uint32_t> nanoflann_weld(const std::vector<point3>& points,
                                                        double tolerance);

}  // namespace treeform::bench
