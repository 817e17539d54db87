#pragma once
/// \file
/// Halos around what was found and is too small to be seen.

#include "tools/picture/canvas.hpp"

#include <cstdint>
#include <vector>

namespace tools {

/// `found` [height][width]: the class of what was found at each pixel, plus 1; 0 where nothing was.
/// Where few pixels of it are together, those around have its color, too.
void add_halos(picture& on, const std::vector<std::uint8_t>& found, const std::vector<rgb>& colors);

}  // namespace tools
