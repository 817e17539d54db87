#pragma once
/// \file
/// Colors faces and vertices by class.

#include <treeform/mesh/attributes.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::attribute {

/// Sets the columns red, green and blue of each row to the color of its class.
///
/// \pre `classes` has one class for each row; `colors` has a color "#rrggbb" for each class
inline void set_colors(element& rows, std::span<const std::uint8_t> classes,
                       std::span<const char* const> colors) {
    constexpr const char* names[] = {"red", "green", "blue"};
    std::vector<std::uint8_t> of_class(colors.size());
    std::vector<std::uint8_t> values(classes.size());
    for (std::size_t which = 0; which < 3; ++which) {
        for (std::size_t c = 0; c < colors.size(); ++c)
            of_class[c] = static_cast<std::uint8_t>(
                std::stoi(std::string(colors[c]).substr(1 + 2 * which, 2), nullptr, 16));
        for (std::size_t i = 0; i < classes.size(); ++i) values[i] = of_class[classes[i]];
        rows.set(column::of<std::uint8_t>(names[which], values));
    }
}

}  // namespace treeform::detail::attribute
