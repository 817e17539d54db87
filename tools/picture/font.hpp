#pragma once
/// \file
/// Letters of strokes, of any size.

#include "tools/picture/canvas.hpp"

#include <string>
#include <string_view>

namespace tools {

/// The width of a line of text in which capitals have the height `size`.
[[nodiscard]] double text_width(std::string_view text, double size);

/// `text`, UTF-8, on a line that begins at `at`. A letter beyond ASCII is a box.
void draw_text(picture& on, pixel_position at, std::string_view text, double size,
               const rgb& color);

/// The same with a rim of paper around it, for on top of things.
void draw_label(picture& on, pixel_position at, std::string_view text, double size,
                const rgb& color);

/// `text`, or its beginning and "..." where it is wider than `room`.
[[nodiscard]] std::string shortened(const std::string& text, double size, double room);

}  // namespace tools
