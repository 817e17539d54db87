#include "tools/common/help_text.hpp"

#include <cstddef>

namespace tools {
namespace {

constexpr std::size_t text_column = 26;
constexpr std::size_t width = 79;

std::string left_column(const option_text& option) {
    const std::string& names = option.label.empty() ? option.names : option.label;
    std::string left = names.starts_with("--") ? "      " : "  ";
    left += names;
    if (!option.value.empty() && !option.value.starts_with('[')) left += ' ';
    left += option.value;
    if (left.size() < text_column) return left.append(text_column - left.size(), ' ');
    return left + "  ";
}

std::string lay_out(const option_text& option) {
    std::string out = left_column(option);
    std::size_t line_start = 0;
    for (const char c : option.text) {
        out += c;
        if (c != '\n') continue;
        line_start = out.size();
        out.append(text_column, ' ');
    }
    if (!option.fallback.empty()) {
        const std::string note = "[" + option.fallback + "]";
        if (out.size() - line_start + 2 + note.size() > width) {
            out += '\n';
            line_start = out.size();
        }
        out.append(width - note.size() - (out.size() - line_start), ' ');
        out += note;
    }
    return out + '\n';
}

}  // namespace

std::string lay_out(const option_group& group) {
    std::string out = group.title.empty() ? std::string() : group.title + ":\n";
    for (const option_text& option : group.options)
        if (!option.text.empty()) out += lay_out(option);
    return out;
}

}  // namespace tools
