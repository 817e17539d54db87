#include <libmesh/io/heading.hpp>
#include <libmesh/io/number.hpp>

#include <algorithm>

namespace treeform::detail::io {

namespace {

[[nodiscard]] char separator_of(std::string_view line) {
    for (const char c : {';', ',', '\t'})
        if (line.find(c) != std::string_view::npos) return c;
    return ' ';
}

/// A name as a column may have it.
[[nodiscard]] std::string clean(std::string_view cell) {
    while (!cell.empty() && is_space(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && is_space(cell.back())) cell.remove_suffix(1);
    std::string name(cell);
    std::replace_if(name.begin(), name.end(), is_space, '_');
    return name;
}

}  // namespace

std::vector<std::string> split_heading(std::string_view line) {
    const char separator = separator_of(line);
    std::vector<std::string> names;
    std::string cell;
    bool quoted = false;
    const auto end_cell = [&] {
        std::string name = clean(cell);
        if (separator != ' ' || !name.empty()) names.push_back(std::move(name));
        cell.clear();
    };
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool ends = separator == ' ' ? is_blank(c) : c == separator;
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cell += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (ends && !quoted)
            end_cell();
        else
            cell += c;
    }
    end_cell();
    return names;
}

std::optional<std::array<std::size_t, 3>> find_axes(const std::vector<std::string>& names) {
    std::array<std::size_t, 3> axes{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
            return name.size() == 1 && to_lower(name[0]) == "xyz"[axis];
        });
        if (at == names.end()) return std::nullopt;
        axes[axis] = static_cast<std::size_t>(at - names.begin());
    }
    return axes;
}

}  // namespace treeform::detail::io
