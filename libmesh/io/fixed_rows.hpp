#pragma once
/// \file
/// Binary rows of fixed size: PLY without lists, PCD.

#include <libmesh/io/row_values.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::io {

/// The position of a column's value in the first row, and the distance to that in the next row.
struct value_place {
    const char* first = nullptr;
    std::size_t stride = 0;
};

/// Appends `rows` points and their rows to `points` and to the columns of `vertices`; `places` has
/// one entry for each column. Works column by column on blocks of rows that fit into the L1 cache,
/// so that each loop has a single type.
void append_fixed_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                       std::span<const value_place> places, std::endian order);

/// Size of a row in bytes; zero if there is a list.
[[nodiscard]] std::size_t fixed_row_size(const element& e);

/// Rows of equal size.
struct alike_rows {
    std::uint64_t count = 0;
    std::uint64_t size = 0;
};

/// Divides rows, of which the first is at byte `begin`, into `count` parts of about equal size in
/// bytes. Returns the begin of each part and the end of the last.
[[nodiscard]] std::vector<row_place> parts_of_rows(std::uint64_t begin,
                                                   std::span<const alike_rows> rows,
                                                   std::size_t count);

template <class Values>
void read_data(Values& values, column& c) {
    if (!c.list_length) return values.scalar(c);
    for (std::size_t left = values.length(c); left > 0; --left) values.scalar(c);
    c.list_begin.push_back(c.size());
}

/// Appends a row to the columns of `e`. `take_corners` reads the corners; its result is returned.
template <class Values, class F>
bool read_row(Values& values, element& e, const F& take_corners) {
    bool taken = true;
    values.begin_row();
    for (column& c : e.columns)
        if (c.role == column_role::corners)
            taken = take_corners(c);
        else
            read_data(values, c);
    values.end_row();
    return taken;
}

/// Value by value, for text and for rows with lists.
template <class Values>
void append_vertices_one_by_one(Values& values, element& vertices, std::vector<point3>& points,
                                std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
        point3 p;
        values.begin_row();
        for (column& c : vertices.columns) {
            if (c.role == column_role::data)
                read_data(values, c);
            else
                p[axis_number(c.role)] = values.coordinate(c);
        }
        values.end_row();
        points.push_back(p);
    }
}

/// Appends the next `rows` points and their rows to `points` and to the columns of `vertices`.
inline void append_vertices(text_values& values, element& vertices, std::vector<point3>& points,
                            std::size_t rows) {
    append_vertices_one_by_one(values, vertices, points, rows);
}

/// The same for bytes. \pre `can_hold` is true for the rows
template <std::endian order>
void append_vertices(byte_values<order>& values, element& vertices, std::vector<point3>& points,
                     std::size_t rows) {
    const std::size_t row_size = fixed_row_size(vertices);
    if (row_size == 0) return append_vertices_one_by_one(values, vertices, points, rows);
    // In pieces, so that the memory of a mapped file is released during reading.
    constexpr std::size_t most = std::size_t{1} << 20;
    const std::size_t at_once = std::max<std::size_t>(1, most / row_size);
    std::vector<value_place> places(vertices.columns.size());
    for (std::size_t done = 0; done < rows; done += at_once) {
        const std::size_t some = std::min(at_once, rows - done);
        const char* at = values.take_bytes(some * row_size);
        for (std::size_t i = 0; i < places.size(); ++i) {
            places[i] = {at, row_size};
            at += size_of(vertices.columns[i].type);
        }
        append_fixed_rows(vertices, points, some, places, order);
        values.end_row();
    }
}

}  // namespace treeform::detail::io
