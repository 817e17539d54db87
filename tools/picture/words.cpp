#include "tools/picture/words.hpp"

#include <charconv>

namespace tools {

std::string with_unit(double value, const std::string& unit) {
    char text[32];
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
    return std::string(text, end) + (unit.empty() ? "" : " " + unit);
}

}  // namespace tools
