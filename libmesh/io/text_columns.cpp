#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/text_columns.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <initializer_list>
#include <system_error>
#include <utility>

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

[[nodiscard]] std::size_t find_source(const source& in, const std::vector<std::string>& names,
                                      const std::string& wanted) {
    const auto at = std::ranges::find(names, wanted);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    std::size_t number = 0;
    const char* const end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(wanted.data(), end, number);
    if (error == std::errc() && stop == end && number >= 1 && number <= names.size())
        return number - 1;
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    in.fail("columns: there is no column '" + wanted + "' among " + known);
}

[[nodiscard]] bool is_whole(const text_column& fact) { return fact.whole && fact.gaps == 0; }

/// Whole numbers up to 255 or 65535 in all of them are of so many bits.
[[nodiscard]] scalar_type type_of_colors(const std::vector<text_column>& colors) {
    double most = 0.0;
    for (const text_column& fact : colors) {
        if (!is_whole(fact) || fact.min < 0.0) return scalar_type::float64;
        most = std::max(most, fact.max);
    }
    if (colors.size() < 3 || most > 65535.0) return scalar_type::float64;
    return most > 255.0 ? scalar_type::uint16 : scalar_type::uint8;
}

[[nodiscard]] bool is_color(const column& c) {
    return attribute::is_use(c.name, attribute::column_use::color);
}

/// Calls f(column, fact) for those that are data.
template <class Element, class F>
void for_each_fact(Element& declared, std::span<const text_column> facts, F&& f) {
    std::size_t place = 0;
    for (auto& c : declared.columns)
        if (c.role == column_role::data && place < facts.size()) f(c, facts[place++]);
}

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

bool take_whole(const char* at, const char* end, text_cell& c, text_column& fact) {
    constexpr std::uint64_t exact = std::uint64_t{1} << 53;
    constexpr std::uint64_t most = std::uint64_t{1} << 63;
    const bool negative = *at == '-';
    if (*at == '-' || *at == '+') ++at;
    std::uint64_t number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc() || stop != end || (negative && number > most)) return false;
    c.bits = negative ? std::uint64_t{0} - number : number;
    fact.beyond = fact.beyond || number > exact;
    fact.unsigned_only = fact.unsigned_only || (!negative && number >= most);
    return true;
}

std::optional<std::array<std::size_t, 3>> choose_columns(
    const source& in, std::span<const std::pair<std::string, std::string>> chosen,
    std::vector<std::string>& names) {
    std::array<std::optional<std::size_t>, 3> axes{};
    const std::vector<std::string> before = names;
    for (const auto& [name, source] : chosen) {
        const std::size_t at = find_source(in, before, source);
        if (name == "x" || name == "y" || name == "z")
            axes[static_cast<std::size_t>(name[0] - 'x')] = at;
        names[at] = name;
    }
    if (!axes[0] && !axes[1] && !axes[2]) return std::nullopt;
    if (!axes[0] || !axes[1] || !axes[2])
        in.fail("columns: choose x, y and z together, or none of them");
    if (axes[0] == axes[1] || axes[0] == axes[2] || axes[1] == axes[2])
        in.fail("columns: x, y and z must be three different columns");
    return std::array{*axes[0], *axes[1], *axes[2]};
}

void choose_types(element& declared, std::span<const text_column> facts) {
    std::vector<text_column> colors;
    for_each_fact(declared, facts, [&](const column& c, const text_column& fact) {
        if (is_color(c)) colors.push_back(fact);
    });
    for_each_fact(declared, facts, [&](column& c, const text_column& fact) {
        c.type = scalar_type::float64;
        if (!is_whole(fact)) return;
        if (fact.beyond && !fact.unsigned_only)
            c.type = scalar_type::int64;
        else if (fact.beyond && fact.min >= 0.0)
            c.type = scalar_type::uint64;
        else if (!fact.beyond && is_color(c))
            c.type = type_of_colors(colors);
    });
}

void remark_on_cells(const element& declared, std::span<const text_column> facts,
                     std::vector<io_warning>& warnings) {
    std::uint64_t gaps = 0;
    std::string empty, rounded;
    for_each_fact(declared, facts, [&](const column& c, const text_column& fact) {
        gaps += fact.gaps;
        if (fact.gaps > 0) empty += (empty.empty() ? "" : ", ") + c.name;
        if (fact.beyond && c.type == scalar_type::float64)
            rounded += (rounded.empty() ? "" : ", ") + c.name;
    });
    if (gaps > 0)
        warnings.push_back({"columns", std::to_string(gaps) +
                                           (gaps == 1 ? " cell of " : " cells of ") + empty +
                                           " empty or not a number: read as NaN"});
    if (!rounded.empty())
        warnings.push_back({"columns",
                            "whole numbers beyond 2^53 are rounded, since other values "
                            "of the column are not whole numbers: " +
                                rounded});
}

void append_cells(column& to, std::span<const text_cell> cells, const cell_places& places) {
    const std::size_t before = to.values.size();
    with_type(to.type, [&]<class T>(T) {
        to.values.resize(before + places.rows * sizeof(T));
        for (std::size_t row = 0; row < places.rows; ++row) {
            const text_cell& from = cells[places.first + row * places.width];
            T value = static_cast<T>(from.bits);
            if constexpr (std::is_floating_point_v<T>) value = static_cast<T>(from.value);
            std::memcpy(to.values.data() + before + row * sizeof(T), &value, sizeof(T));
        }
    });
}

void retype(column& c, scalar_type type) {
    if (c.type == type) return;
    with_type(type, [&]<class T>(T) {
        c = column_of<T>(c.name, c.size(),
                         [&](std::size_t i) { return static_cast<T>(c.number(i)); });
    });
}

}  // namespace treeform::detail::io
