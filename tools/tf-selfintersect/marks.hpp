#pragma once
/// \file
/// The kind and the region of each face, and the colors that show them.

#include "tools/tf-selfintersect/search.hpp"
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tools {

struct face_marks {
    std::vector<std::uint8_t> kind;    ///< [F] 0: in no pair; else 1 + the gravest `pair_kind`
    std::vector<std::int32_t> region;  ///< [F] -1: in no pair
};

/// For the faces that were searched.
[[nodiscard]] face_marks mark_faces(const findings& result);

/// "#rrggbb" of each mark: gray for faces in no pair, then by `pair_kind`.
inline constexpr std::array<const char*, 1 + tf::pair_kind_count> mark_colors{
    "#b4bac2", "#e02020", "#f08c00", "#ecd000", "#d81fbf", "#7432d6", "#00a0c0", "#6b4a2b"};

}  // namespace tools
