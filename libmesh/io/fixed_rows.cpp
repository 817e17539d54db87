#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/row_values.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>

namespace treeform::detail::io {

namespace {

template <std::endian order>
void read_axis(scalar_type type, point3* points, std::size_t rows, value_place from,
               std::size_t axis) {
    with_type(type, [&]<class T>(T) {
        for (std::size_t row = 0; row < rows; ++row)
            points[row][axis] =
                static_cast<double>(base::load<T, order>(from.first + row * from.stride));
    });
}

/// As whole numbers of that size, so that no bit of a float changes on its way.
template <std::endian order, class T>
void read_bits(std::byte* to, std::size_t rows, value_place from) {
    for (std::size_t row = 0; row < rows; ++row) {
        const T bits = base::load<T, order>(from.first + row * from.stride);
        std::memcpy(to + row * sizeof(T), &bits, sizeof(T));
    }
}

template <std::endian order>
void read_data(column& c, std::size_t rows, value_place from) {
    const std::size_t before = c.values.size();
    c.values.resize(before + rows * size_of(c.type));
    with_bits(c.type,
              [&]<class T>(T) { read_bits<order, T>(c.values.data() + before, rows, from); });
}

template <std::endian order>
void append_some(element& vertices, std::vector<point3>& points, std::size_t rows,
                 std::span<const value_place> places, std::size_t skipped) {
    const std::size_t before = points.size();
    points.resize(before + rows);
    for (std::size_t i = 0; i < places.size(); ++i) {
        column& c = vertices.columns[i];
        const value_place from{places[i].first + skipped * places[i].stride, places[i].stride};
        if (c.role == column_role::data)
            read_data<order>(c, rows, from);
        else
            read_axis<order>(c.type, points.data() + before, rows, from, axis_number(c.role));
    }
}

}  // namespace

void append_fixed_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                       std::span<const value_place> places, std::endian order) {
    constexpr std::size_t at_once = 512;
    for (std::size_t done = 0; done < rows; done += at_once) {
        const std::size_t some = std::min(at_once, rows - done);
        if (order == std::endian::little)
            append_some<std::endian::little>(vertices, points, some, places, done);
        else
            append_some<std::endian::big>(vertices, points, some, places, done);
    }
}

std::size_t fixed_row_size(const element& e) {
    std::size_t size = 0;
    for (const column& c : e.columns) {
        if (c.list_length) return 0;
        size += size_of(c.type);
    }
    return size;
}

std::vector<row_place> parts_of_rows(std::uint64_t begin, std::span<const alike_rows> rows,
                                     std::size_t count) {
    std::uint64_t bytes = 0;
    for (const alike_rows& some : rows) bytes += some.count * some.size;
    std::vector<row_place> parts;
    row_place at{.row = 0, .byte = 0};  // of `rows.front()`
    for (std::uint64_t part = 0; part <= count; ++part) {
        const std::uint64_t wanted =
            bytes / count * part + bytes % count * part / count;  // without overflow
        while (!rows.empty() && wanted >= at.byte + rows.front().count * rows.front().size) {
            at.row += rows.front().count;
            at.byte += rows.front().count * rows.front().size;
            rows = rows.subspan(1);
        }
        const std::uint64_t more = rows.empty() ? 0 : (wanted - at.byte) / rows.front().size;
        parts.push_back({.row = at.row + more,
                         .byte = begin + at.byte + (more == 0 ? 0 : more * rows.front().size)});
    }
    return parts;
}

}  // namespace treeform::detail::io
