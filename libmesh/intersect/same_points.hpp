#pragma once
/// \file
/// Finds equal constructed points, regardless of their definitions.

#include <libmesh/exact/implicit_point.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::intersect {

/// Pairs of equal points that link all equal points. Candidates are points whose error balls
/// overlap; these are nearly always equal.
/// \same on any number of threads
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> equal_pairs(
    std::span<const implicit_point> points);

}  // namespace treeform::detail::intersect
