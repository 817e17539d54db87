#pragma once
/// \file
/// Colors faces and vertices by class.

#include <treeform/mesh/attributes.hpp>

#include <cstdint>
#include <span>

namespace treeform::detail::attribute {

/// Sets the columns red, green and blue of each row to the color of its class.
///
/// \pre `classes` has one class for each row; `colors` has a color "#rrggbb" for each class
void set_colors(element& rows, std::span<const std::uint8_t> classes,
                std::span<const char* const> colors);

}  // namespace treeform::detail::attribute
