#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <utility>

namespace treeform {

namespace {

template <class T>
double load(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

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
    const auto at =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
    return at == rows.end() ? nullptr : &*at;
}

}  // namespace

double column::number(std::size_t i) const {
    const std::byte* at = values.data() + i * size_of(type);
    switch (type) {
        case scalar_type::int8:
            return load<std::int8_t>(at);
        case scalar_type::uint8:
            return load<std::uint8_t>(at);
        case scalar_type::int16:
            return load<std::int16_t>(at);
        case scalar_type::uint16:
            return load<std::uint16_t>(at);
        case scalar_type::int32:
            return load<std::int32_t>(at);
        case scalar_type::uint32:
            return load<std::uint32_t>(at);
        case scalar_type::int64:
            return load<std::int64_t>(at);
        case scalar_type::uint64:
            return load<std::uint64_t>(at);
        case scalar_type::float32:
            return load<float>(at);
        case scalar_type::float64:
            break;
    }
    return load<double>(at);
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

}  // namespace treeform
