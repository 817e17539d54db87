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

}  // namespace

double number_at(const column& c, std::size_t i) {
    const std::byte* at = c.values.data() + i * size_of(c.type);
    switch (c.type) {
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

element gather(const element& e, std::span<const std::uint32_t> rows) {
    element out{.name = e.name, .rows = rows.size()};
    out.columns.reserve(e.columns.size());
    for (const column& c : e.columns) out.columns.push_back(gather(c, rows));
    return out;
}

const column* find_column(const element& e, std::string_view name) {
    const auto at = std::find_if(e.columns.begin(), e.columns.end(),
                                 [&](const column& c) { return c.name == name; });
    return at == e.columns.end() ? nullptr : &*at;
}

bool set_column(element& e, column c) {
    if (const column* found = find_column(e, c.name)) {
        const_cast<column&>(*found) = std::move(c);
        return true;
    }
    e.columns.push_back(std::move(c));
    return false;
}

const element* find_element(const attributes& a, std::string_view name) {
    const auto at = std::find_if(a.elements.begin(), a.elements.end(),
                                 [&](const element& e) { return e.name == name; });
    return at == a.elements.end() ? nullptr : &*at;
}

element& obtain_element(attributes& a, std::string_view name, std::size_t rows) {
    if (const element* found = find_element(a, name)) return const_cast<element&>(*found);
    a.elements.push_back({.name = std::string(name), .rows = rows});
    return a.elements.back();
}

}  // namespace treeform
