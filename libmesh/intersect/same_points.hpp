#pragma once
/// \file
/// Which constructed points are one point, whatever defines them.

#include <libmesh/exact/implicit_point.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::intersect {

/// Pairs of points that are equal, enough of them to link all that are. Candidates are points whose
/// balls overlap, which are equal nearly always.
/// \same on any number of threads
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> equal_pairs(
    std::span<const implicit_point> points);

}  // namespace treeform::detail::intersect
