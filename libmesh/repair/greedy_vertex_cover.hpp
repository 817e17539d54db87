#pragma once
/// \file
/// Chooses the faces to delete from pairs that meet.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// [F] 1 for the faces to delete: a small set that contains a face of each pair.
///
/// Of two faces with `spared` 0, the one that meets more remaining faces is deleted, or else the
/// lower one; of a spared face and another, the other; of two spared faces, both; also a face
/// paired with itself.
[[nodiscard]] std::vector<std::uint8_t> greedy_vertex_cover(
    std::span<const std::array<std::uint32_t, 2>> pairs, std::span<const std::uint8_t> spared);

}  // namespace treeform::detail::repair
