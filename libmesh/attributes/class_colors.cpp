#include <libmesh/attributes/class_colors.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::attribute {
namespace {

std::uint8_t channel(std::string_view color, std::size_t which) {
    return static_cast<std::uint8_t>(
        std::stoi(std::string(color.substr(1 + 2 * which, 2)), nullptr, 16));
}

}  // namespace

void set_colors(element& rows, std::span<const std::uint8_t> classes,
                std::span<const char* const> colors) {
    constexpr const char* names[] = {"red", "green", "blue"};
    std::vector<std::uint8_t> of_class(colors.size());
    std::vector<std::uint8_t> values(classes.size());
    for (std::size_t which = 0; which < 3; ++which) {
        for (std::size_t c = 0; c < colors.size(); ++c) of_class[c] = channel(colors[c], which);
        for (std::size_t i = 0; i < classes.size(); ++i) values[i] = of_class[classes[i]];
        rows.set(column::of<std::uint8_t>(names[which], values));
    }
}

}  // namespace treeform::detail::attribute
