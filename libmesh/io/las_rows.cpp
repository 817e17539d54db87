#include <libmesh/base/byte_order.hpp>
#include <libmesh/io/las_rows.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace treeform::detail::io {

namespace {

/// Some records one behind the other: what the loops below go over.
struct record_run {
    const char* first = nullptr;
    std::size_t size = 0;
    std::size_t count = 0;
};

void read_axes(point3* points, const record_run& from, const las_grid& grid) {
    for (std::size_t i = 0; i < from.count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            points[i][axis] = grid.coordinate(axis, base::load<std::int32_t, std::endian::little>(
                                                        from.first + i * from.size + 4 * axis));
}

/// As whole numbers of that size, so that no bit of a float changes on its way.
template <class T>
void read_values(std::byte* to, const record_run& from, std::size_t byte) {
    for (std::size_t i = 0; i < from.count; ++i) {
        const T bits = base::load<T, std::endian::little>(from.first + i * from.size + byte);
        std::memcpy(to + i * sizeof(T), &bits, sizeof(T));
    }
}

void read_bits(std::byte* to, const record_run& from, const las_dimension& d) {
    const unsigned mask = (1u << d.bits) - 1;
    for (std::size_t i = 0; i < from.count; ++i) {
        const auto byte = static_cast<unsigned char>(from.first[i * from.size + d.byte]);
        to[i] = static_cast<std::byte>(byte >> d.shift & mask);
    }
}

/// The product is rounded, then the sum: this is compiled without contraction.
void read_scaled(std::byte* to, const record_run& from, const las_dimension& d) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    with_type(d.type, [&]<class T>(T) {
        for (std::size_t i = 0; i < from.count; ++i) {
            const auto stored = static_cast<double>(
                base::load<T, std::endian::little>(from.first + i * from.size + d.byte));
            const double product = stored * d.scaling->scale;
            const double value = stored == d.scaling->no_data ? nan : product + d.scaling->offset;
            std::memcpy(to + i * sizeof value, &value, sizeof value);
        }
    });
}

void read_dimension(std::byte* to, const record_run& from, const las_dimension& d) {
    if (d.bits > 0) return read_bits(to, from, d);
    if (d.scaling) return read_scaled(to, from, d);
    switch (size_of(d.type)) {
        case 1:
            return read_values<std::uint8_t>(to, from, d.byte);
        case 2:
            return read_values<std::uint16_t>(to, from, d.byte);
        case 4:
            return read_values<std::uint32_t>(to, from, d.byte);
        default:
            return read_values<std::uint64_t>(to, from, d.byte);
    }
}

}  // namespace

element las_columns(std::span<const las_dimension> dimensions) {
    element vertices{.name = "vertex"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        vertices.columns.push_back({.name = std::string(1, "xyz"[axis]),
                                    .type = scalar_type::float64,
                                    .role = role_of_axis(axis)});
    for (const las_dimension& d : dimensions)
        vertices.columns.push_back({.name = d.name, .type = d.column_type()});
    return vertices;
}

void append_las_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                     const char* first, std::size_t record_size, const las_grid& grid,
                     std::span<const las_dimension> dimensions) {
    const std::size_t before = points.size();
    points.resize(before + rows);
    const std::span<column> data = std::span(vertices.columns).subspan(3);
    std::vector<std::byte*> to(dimensions.size());
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
        std::vector<std::byte>& values = data[d].values;
        const std::size_t size = values.size();
        values.resize(size + rows * size_of(dimensions[d].column_type()));
        to[d] = values.data() + size;
    }
    // A column at a time, over what the first cache holds.
    constexpr std::size_t at_once = 512;
    for_chunks(rows, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t at = begin; at < end; at += at_once) {
            const record_run run{first + at * record_size, record_size,
                                 std::min(at_once, end - at)};
            read_axes(points.data() + before + at, run, grid);
            for (std::size_t d = 0; d < dimensions.size(); ++d)
                read_dimension(to[d] + at * size_of(dimensions[d].column_type()), run,
                               dimensions[d]);
        }
    });
}

}  // namespace treeform::detail::io
