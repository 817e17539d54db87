#pragma once
/// \file
/// Common code of the readers of whole PLY files and of blocks.

#include <libmesh/io/ply_header.hpp>
#include <libmesh/io/row_values.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::io {

inline constexpr std::uint32_t most_numbers = std::numeric_limits<std::uint32_t>::max();

/// The element "vertex", which must exist and have all coordinates.
[[nodiscard]] inline element& vertices_of(const source& in, std::vector<element>& elements) {
    const auto at = std::ranges::find(elements, "vertex", &element::name);
    if (at == elements.end()) in.fail("no element 'vertex' in the header");
    for (const auto role : {column_role::x, column_role::y, column_role::z})
        if (with_role(*at, role) == nullptr) in.fail("element 'vertex' lacks one of x, y, z");
    return *at;
}

inline void take_remarks(ply_header& header, mesh_file& file) {
    file.attributes.texture_files = std::move(header.texture_files);
    file.attributes.comments = std::move(header.comments);
    file.attributes.obj_info = std::move(header.obj_info);
}

template <class Values>
void check_room(const Values& values, const element& e) {
    if (!Values::can_hold(values.bytes_left(), e.rows, e))
        values.fail("the file ends within element " + e.name + ": " + std::to_string(e.rows) +
                    " rows announced");
}

template <class Values>
void look_behind(Values& values, std::vector<io_warning>& warnings) {
    if (!values.only_blanks_left())
        warnings.push_back({"trailing-bytes", "data after the last element were not read"});
    values.remark(warnings);
}

/// Whether rows can be skipped by their size in bytes.
template <class Values>
inline constexpr bool has_bytes = requires(Values v) {
    v.take_bytes(0);
};

/// Size in bytes of the next row of `e`, and of all rows if they are alike; sets `corners` to its
/// number of corners. Zero if there is a list other than the corners, or the row does not fit.
template <class Values>
std::size_t alike_row_size(Values values, const element& e, std::optional<std::size_t>& corners) {
    const std::size_t before = values.bytes_left();
    for (const column& c : e.columns) {
        if (c.list_length && c.role != column_role::corners) return 0;
        const std::size_t count = c.list_length ? values.length(c) : 1;
        if (c.list_length) corners = count;
        if (count * size_of(c.type) > values.bytes_left()) return 0;
        static_cast<void>(values.take_bytes(count * size_of(c.type)));
    }
    return before - values.bytes_left();
}

/// Calls f with the name of the format and the reader of values.
template <class F>
void with_reader(const source& in, const ply_header& header, F&& f) {
    switch (header.encoding) {
        case ply_encoding::ascii:
            return f("ply-ascii", text_values(in, header.body));
        case ply_encoding::little_endian:
            return f("ply-binary-le", byte_values<std::endian::little>(in, header.body));
        case ply_encoding::big_endian:
            return f("ply-binary-be", byte_values<std::endian::big>(in, header.body));
    }
}

}  // namespace treeform::detail::io
