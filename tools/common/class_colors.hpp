#pragma once
/// \file
/// Faces and vertices in the colors of their classes.

#include <treeform/mesh/attributes.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <span>

namespace tools {

/// Gives each row of `element` the color of its class, as the columns red, green and blue.
///
/// \pre `classes` has one for each row, each of which has a color, "#rrggbb"
void set_colors(tf::element& element, std::span<const std::uint8_t> classes,
                std::span<const char* const> colors);

}  // namespace tools
