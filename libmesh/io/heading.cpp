#include <libmesh/io/heading.hpp>
#include <libmesh/io/number.hpp>

#include <algorithm>
#include <initializer_list>

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

using words = std::initializer_list<std::string_view>;

[[nodiscard]] std::optional<std::size_t> find_any(const std::vector<std::string>& names, words of) {
    for (const std::string_view word : of)
        for (std::size_t i = 0; i < names.size(); ++i)
            if (std::equal(names[i].begin(), names[i].end(), word.begin(), word.end(),
                           [](char a, char b) { return to_lower(a) == b; }))
                return i;
    return std::nullopt;
}

/// What x, y and z are called, the usual first. Names of different rows do not go together.
const std::array<words, 3> axis_names[] = {
    {{{"x"}, {"y"}, {"z"}}},
    {{{"pos_x", "position_x", "x_pos", "posx"},
      {"pos_y", "position_y", "y_pos", "posy"},
      {"pos_z", "position_z", "z_pos", "posz"}}},
    {{{"x_coord", "x_coordinate", "coord_x", "point_x", "xcoord"},
      {"y_coord", "y_coordinate", "coord_y", "point_y", "ycoord"},
      {"z_coord", "z_coordinate", "coord_z", "point_z", "zcoord"}}},
    {{{"points:0", "points_0", "coordinates:0"},
      {"points:1", "points_1", "coordinates:1"},
      {"points:2", "points_2", "coordinates:2"}}},
    {{{"easting", "east", "e"},
      {"northing", "north", "n"},
      {"elevation", "elev", "height", "altitude", "z", "h"}}}};

}  // namespace

bool has_angles(const std::vector<std::string>& names) {
    return find_any(names, {"latitude", "lat"}) &&
           find_any(names, {"longitude", "lon", "long", "lng"});
}

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
    for (const std::array<words, 3>& called : axis_names) {
        const auto x = find_any(names, called[0]), y = find_any(names, called[1]),
                   z = find_any(names, called[2]);
        if (x && y && z) return std::array{*x, *y, *z};
    }
    return std::nullopt;
}

}  // namespace treeform::detail::io
