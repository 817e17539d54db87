#pragma once
/// \file
/// Faces and vertices in the colors of their classes.

#include <treeform/mesh/attributes.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::attribute {

/// Gives each row the color of its class, as the columns red, green and blue.
///
/// \pre `classes` has one for each row, each of which has a color, "#rrggbb"
void set_colors(element& rows, std::span<const std::uint8_t> classes,
                std::span<const char* const> colors);

}  // namespace treeform::detail::attribute
