#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <utility>

namespace treeform {

namespace {

column gather(const column& c, std::span<const std::uint32_t> rows) {
    column out{.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role};
    if (c.role != column_role::data) return out;
    const std::size_t size = size_of(c.type);
    const auto append = [&](std::uint64_t first, std::uint64_t last) {
        const auto* values = c.values.data();
        out.values.insert(out.values.end(), values + first * size, values + last * size);
    };
    if (!c.list_length) {
        out.values.reserve(rows.size() * size);
        for (const std::uint32_t row : rows) append(row, std::uint64_t{row} + 1);
        return out;
    }
    out.list_begin.reserve(rows.size() + 1);
    out.list_begin.push_back(0);
    for (const std::uint32_t row : rows) {
        append(c.list_begin[row], c.list_begin[row + std::size_t{1}]);
        out.list_begin.push_back(out.values.size() / size);
    }
    return out;
}

template <class Row>
const Row* named(const std::vector<Row>& rows, std::string_view name) {
    const auto at = std::ranges::find(rows, name, &Row::name);
    return at == rows.end() ? nullptr : &*at;
}

std::vector<face> gather(const std::vector<face>& numbers,
                         std::span<const std::uint32_t> triangles) {
    std::vector<face> rows;
    if (numbers.empty()) return rows;
    rows.reserve(triangles.size());
    for (const std::uint32_t t : triangles) rows.push_back(numbers[t]);
    return rows;
}

/// Behind numbers of `before` triangles; the new ones are of rows that follow `rows` others.
void append_numbers(std::vector<face>& to, const std::vector<face>& more, std::size_t rows,
                    std::size_t before, std::size_t after) {
    constexpr std::uint32_t none = corner_values::none;
    if (to.empty() && more.empty()) return;
    to.resize(before, {none, none, none});
    for (face numbers : more) {
        for (std::uint32_t& row : numbers)
            if (row != none) row += static_cast<std::uint32_t>(rows);
        to.push_back(numbers);
    }
    to.resize(after, {none, none, none});
}

std::string fault_of(const std::vector<face>& numbers, std::size_t rows, std::size_t triangles,
                     const std::string& what) {
    if (numbers.empty()) return {};
    if (numbers.size() != triangles)
        return what + " numbers of " + std::to_string(numbers.size()) + " triangles for " +
               std::to_string(triangles);
    for (std::size_t f = 0; f < numbers.size(); ++f)
        for (const std::uint32_t row : numbers[f])
            if (row >= rows && row != corner_values::none)
                return "a corner of triangle " + std::to_string(f) + " has a " + what +
                       " number that is out of range";
    return {};
}

}  // namespace

double column::number(std::size_t i) const {
    return with_type(type, [&]<class T>(T value) {
        std::memcpy(&value, values.data() + i * sizeof value, sizeof value);
        return static_cast<double>(value);
    });
}

element element::gathered(std::span<const std::uint32_t> which) const {
    element out{.name = name, .rows = which.size()};
    out.columns.reserve(columns.size());
    for (const column& c : columns) out.columns.push_back(gather(c, which));
    return out;
}

const column* element::find(std::string_view column_name) const {
    return named(columns, column_name);
}

bool element::set(column c) {
    if (const column* found = find(c.name)) {
        const_cast<column&>(*found) = std::move(c);
        return true;
    }
    columns.push_back(std::move(c));
    return false;
}

const element* attributes::find(std::string_view element_name) const {
    return named(elements, element_name);
}

element& attributes::find_or_add(std::string_view element_name, std::size_t rows) {
    if (const element* found = find(element_name)) return const_cast<element&>(*found);
    elements.push_back({.name = std::string(element_name), .rows = rows});
    return elements.back();
}

corner_values corner_values::gathered(std::span<const std::uint32_t> triangles) const {
    return {.texture = texture,
            .has_w = has_w,
            .normals = normals,
            .texture_of_corner = gather(texture_of_corner, triangles),
            .normal_of_corner = gather(normal_of_corner, triangles)};
}

void corner_values::append(std::size_t triangles, const corner_values& more,
                           std::size_t more_triangles) {
    const std::size_t after = triangles + more_triangles;
    append_numbers(texture_of_corner, more.texture_of_corner, texture.size(), triangles, after);
    append_numbers(normal_of_corner, more.normal_of_corner, normals.size(), triangles, after);
    texture.insert(texture.end(), more.texture.begin(), more.texture.end());
    normals.insert(normals.end(), more.normals.begin(), more.normals.end());
    has_w = has_w || more.has_w;
}

std::string corner_values::fault(std::size_t triangles) const {
    std::string found =
        fault_of(texture_of_corner, texture.size(), triangles, "texture coordinate");
    if (found.empty()) found = fault_of(normal_of_corner, normals.size(), triangles, "normal");
    return found;
}

}  // namespace treeform
