#include "tools/shell/entries.hpp"

#include <cstddef>

namespace tools {
namespace {

/// Whether lists and objects are in each other at most `most` deep.
bool is_shallow(const json& value, std::size_t most) {
    if (!value.is_structured() || value.empty()) return true;
    if (most == 0) return false;
    for (const json& inside : value)
        if (!is_shallow(inside, most - 1)) return false;
    return true;
}

std::string compact(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

void lay_out(const json& value, bool in_list, const std::string& indentation, std::string& text) {
    if (is_shallow(value, in_list ? 2 : value.is_array() ? 1 : 0)) {
        text += compact(value);
        return;
    }
    const std::string inner = indentation + " ";
    char before = value.is_array() ? '[' : '{';
    for (const auto& [key, inside] : value.items()) {
        text += before;
        text += '\n';
        text += inner;
        if (value.is_object()) text += compact(json(key)) + ": ";
        lay_out(inside, value.is_array(), inner, text);
        before = ',';
    }
    text += '\n';
    text += indentation;
    text += value.is_array() ? ']' : '}';
}

}  // namespace

std::string report_text(const json& report) {
    std::string text;
    lay_out(report, false, {}, text);
    return text + '\n';
}

}  // namespace tools
