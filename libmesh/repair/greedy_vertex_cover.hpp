#pragma once
/// \file
/// Which faces to delete where pairs of them meet.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// [F] 1 for few of the faces, of which each pair has one: without them no pair is left.
///
/// Of two faces that may both leave a hole, `spared` being 0 for them, that goes which meets more
/// others that are still there, or else the lower one; of a spared face and another, the other; of
/// two spared ones, or a face that is paired with itself, both.
[[nodiscard]] std::vector<std::uint8_t> greedy_vertex_cover(
    std::span<const std::array<std::uint32_t, 2>> pairs, std::span<const std::uint8_t> spared);

}  // namespace treeform::detail::repair
