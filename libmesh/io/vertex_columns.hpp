#pragma once
/// \file
/// Helpers for the columns of the element "vertex": roles of coordinates, empty columns.

#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// 0, 1, 2 for the roles x, y, z.
[[nodiscard]] constexpr std::size_t axis_number(column_role role) {
    return static_cast<std::size_t>(role) - static_cast<std::size_t>(column_role::x);
}

[[nodiscard]] constexpr column_role role_of_axis(std::size_t axis) {
    return static_cast<column_role>(static_cast<std::size_t>(column_role::x) + axis);
}

[[nodiscard]] inline bool is_axis(const column& c) {
    return c.role == column_role::x || c.role == column_role::y || c.role == column_role::z;
}

[[nodiscard]] inline const column* with_role(const element& e, column_role role) {
    const auto at = std::ranges::find(e.columns, role, &column::role);
    return at == e.columns.end() ? nullptr : &*at;
}

/// Whether float32 can represent every value of the types of the coordinate columns.
[[nodiscard]] inline bool has_single_axes(const element& vertices) {
    return std::all_of(vertices.columns.begin(), vertices.columns.end(), [](const column& c) {
        return c.role == column_role::data || c.type == scalar_type::float32 || size_of(c.type) < 4;
    });
}

/// `f(T{})` for the unsigned type T of as many bytes, by which bits are moved as they stand: on
/// their way through another type, numbers would lose some of NaN.
template <class F>
void with_bits(scalar_type type, F&& f) {
    const std::size_t size = size_of(type);
    if (size == 1) return f(std::uint8_t{});
    if (size == 2) return f(std::uint16_t{});
    if (size == 4) return f(std::uint32_t{});
    f(std::uint64_t{});
}

/// A column with `value(i)` in row i.
template <class T, class F>
[[nodiscard]] column column_of(std::string name, std::size_t rows, const F& value) {
    std::vector<T> values(rows);
    for (std::size_t i = 0; i < rows; ++i) values[i] = value(i);
    return column::of<T>(std::move(name), values);
}

/// Columns red, green and blue, and alpha unless all is opaque, of colors 0xRRGGBBAA.
inline void add_color_columns(element& e, std::span<const std::uint32_t> colors) {
    const bool opaque =
        std::ranges::all_of(colors, [](std::uint32_t c) { return (c & 0xffU) == 0xffU; });
    for (unsigned k = 0; k < (opaque ? 3U : 4U); ++k)
        e.columns.push_back(column_of<std::uint8_t>(
            std::array{"red", "green", "blue", "alpha"}[k], colors.size(),
            [&](std::size_t i) { return static_cast<std::uint8_t>(colors[i] >> (24 - 8 * k)); }));
}

/// A column without its values.
[[nodiscard]] inline column declaration(const column& c) {
    return {.name = c.name, .type = c.type, .list_length = c.list_length, .role = c.role};
}

/// Resets `e` to an element without rows, with the columns of `declared`; keeps its memory.
inline void restart(element& e, const element& declared) {
    e.name = declared.name;
    e.rows = 0;
    e.columns.resize(declared.columns.size());
    for (std::size_t i = 0; i < e.columns.size(); ++i) {
        column& c = e.columns[i];
        std::vector<std::byte> values = std::move(c.values);
        std::vector<std::uint64_t> list_begin = std::move(c.list_begin);
        values.clear();
        list_begin.clear();
        c = declaration(declared.columns[i]);
        if (c.list_length) list_begin.push_back(0);
        c.values = std::move(values);
        c.list_begin = std::move(list_begin);
    }
}

/// Reserves memory for the values of `rows` rows, and begins empty lists.
inline void start_columns(element& e, std::size_t rows) {
    for (column& c : e.columns) {
        if (c.role != column_role::data) continue;
        if (c.list_length)
            c.list_begin.assign(1, 0);
        else
            c.values.reserve(rows * size_of(c.type));
    }
}

/// Removes the values of the last row.
inline void drop_last_row(element& e) {
    for (column& c : e.columns) {
        if (c.role != column_role::data) continue;
        if (c.list_length) c.list_begin.pop_back();
        c.values.resize(c.list_length ? c.list_begin.back() * size_of(c.type)
                                      : c.values.size() - size_of(c.type));
    }
}

/// Sets the number of rows, with values of zero to be filled in. \pre there are no lists
inline void resize_columns(element& e, std::size_t rows) {
    e.rows = rows;
    for (column& c : e.columns)
        if (c.role == column_role::data) c.values.resize(rows * size_of(c.type));
}

}  // namespace treeform::detail::io
