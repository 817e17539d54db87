#pragma once
/// \file
/// An order of points in which neighbors in the list are usually neighbors in space.

#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail {

/// A permutation of 0 ... count - 1, ascending by Morton code of `point_of(i)` in the box of all
/// points, equal codes by number; coordinates that are not finite count as the least. A small
/// number of points is not reordered.
///
/// \cost O(count); `point_of` is called twice for each point
/// \same on any number of threads
template <std::size_t D>
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> morton_order(
    std::size_t count, function_ref<std::array<double, D>(std::size_t)> point_of);

}  // namespace treeform::detail
