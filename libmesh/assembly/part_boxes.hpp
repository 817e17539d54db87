#pragma once
/// \file
/// Parts of an assembly by their boxes: which pairs of them may be near each other.

#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::assembly {

/// The box of the points that faces use, by part; none without faces.
[[nodiscard]] std::vector<std::optional<box3>> boxes_of(std::span<const prepared_mesh> parts);

/// Pairs of parts whose boxes are within `distance` of each other along each axis; ascending, the
/// lower number first.
[[nodiscard]] std::vector<part_pair> near_pairs(const std::vector<std::optional<box3>>& boxes,
                                                double distance);

/// The pairs, ascending, each once, the lower number first.
/// \throws std::invalid_argument for a number of `count` or more; `function` is "clash"
[[nodiscard]] std::vector<part_pair> sorted_pairs(const char* function,
                                                  std::span<const part_pair> pairs,
                                                  std::size_t count);

}  // namespace treeform::detail::assembly
