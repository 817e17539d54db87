#pragma once
/// \file
/// What a picture shows of a scene, and how large.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tools {

/// Views are parallel: lengths across are true to one scale, and what is near hides what is far.
enum class view : std::uint8_t { iso, top, bottom, front, back, left, right };
inline constexpr std::array<const char*, 7> view_names{"iso",  "top",  "bottom", "front",
                                                       "back", "left", "right"};

/// What a picture may measure on a side.
inline constexpr std::size_t least_side = 16;
inline constexpr std::size_t most_side = 16384;

struct picture_options {
    std::size_t width = 1600;
    std::size_t height = 1200;
    std::vector<view> views{view::iso};  ///< one or more, each a pane; before and after: two each
};

}  // namespace tools
