#include <libmesh/io/fixed_rows.hpp>
#include <libmesh/io/lzf.hpp>
#include <libmesh/io/pcd_header.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

using warnings = std::vector<io_warning>;

void look_behind(bool more, warnings& said) {
    if (more) said.push_back({"trailing-bytes", "data after the last point were not read"});
}

[[noreturn]] void fail_short(const source& in, const pcd_header& header) {
    in.fail_byte(header.body, "the file ends within the points: " +
                                  std::to_string(header.vertices.rows) + " announced");
}

[[nodiscard]] std::size_t bytes_of_body(const source& in, const pcd_header& header) {
    return static_cast<std::size_t>(in.end() - header.body);
}

/// A row a line.
[[nodiscard]] auto text_runs(const source& in, const pcd_header& header,
                             const record_index::mark& at, const record_index* known) {
    if (!text_values::can_hold(bytes_of_body(in, header), header.vertices.rows, header.vertices))
        fail_short(in, header);
    const std::uint64_t byte = std::min<std::uint64_t>(at.byte, in.size());
    text_values values(in, std::max(header.body, in.begin() + byte));
    if (known != nullptr) values.expect(*known);
    return [values, left = header.vertices.rows - at.record](std::vector<point3>& points,
                                                             element& vertices, std::size_t most,
                                                             warnings& said) mutable {
        const std::size_t rows = std::min(most, left);
        append_vertices(values, vertices, points, rows);
        left -= rows;
        if (rows == 0) {
            look_behind(!values.only_blanks_left(), said);
            values.remark(said);
        }
        return rows;
    };
}

/// Rows of bytes, which are those of the machines that write such files: little endian.
[[nodiscard]] auto row_runs(const source& in, const pcd_header& header, std::uint64_t first) {
    if (header.vertices.rows > bytes_of_body(in, header) / header.row_size) fail_short(in, header);
    return [&in, at = header.body + first * header.row_size, row_size = header.row_size,
            offsets = header.places,
            left = header.vertices.rows - first](std::vector<point3>& points, element& vertices,
                                                 std::size_t most, warnings& said) mutable {
        constexpr std::size_t megabyte = std::size_t{1} << 20;
        const std::size_t rows = std::min(most, left);
        std::vector<value_place> places(offsets.size());
        for (std::size_t done = 0; done < rows;) {
            const std::size_t some = std::min(rows - done, 1 + megabyte / row_size);
            for (std::size_t i = 0; i < places.size(); ++i)
                places[i] = {at + offsets[i].in_row, row_size};
            append_fixed_rows(vertices, points, some, places, std::endian::little);
            at += some * row_size;
            done += some;
            in.release_before(at);
        }
        left -= rows;
        if (rows == 0) look_behind(at != in.end(), said);
        return rows;
    };
}

/// The unpacked bytes: a block a field.
[[nodiscard]] std::shared_ptr<scratch> unpack(const source& in, const packed_pcd& packed,
                                              scratch_place place) {
    auto bytes = std::make_shared<scratch>(packed.size, place, in.name());
    const bool good =
        lzf_unpack(packed.bytes, bytes->data(), packed.size, [&](std::size_t used, std::size_t) {
            in.release_before(packed.bytes.data() + used);
            bytes->release_memory();
        });
    if (!good) packed.fail_damaged(in);
    return bytes;
}

/// Unpacked when the first of them are asked for, or by others.
[[nodiscard]] auto block_runs(const source& in, const pcd_header& header, scratch_place place,
                              std::uint64_t first, const byte_getter* unpacked) {
    const packed_pcd packed = find_packed_pcd(in, header);
    std::size_t read_size = 0;  // of a row, without padding
    for (const pcd_place& p : header.places) read_size += p.in_field == 0 ? p.field_size : 0;
    return [&in, packed, place, read_size, get = unpacked == nullptr ? byte_getter() : *unpacked,
            bytes = std::shared_ptr<scratch>(), held = std::vector<std::byte>(),
            count = std::size_t{header.vertices.rows}, offsets = header.places,
            first = static_cast<std::size_t>(first)](std::vector<point3>& points, element& vertices,
                                                     std::size_t most, warnings& said) mutable {
        if (!get && !bytes) bytes = unpack(in, packed, place);
        const std::size_t rows = std::min(most, count - first);
        if (rows == 0) {
            look_behind(packed.has_bytes_behind, said);
            return rows;
        }
        if (get) held.resize(rows * read_size);
        std::size_t begin = 0;  // of the field, among those that are read
        std::size_t end = 0;
        std::vector<value_place> places;
        places.reserve(offsets.size());
        for (const pcd_place& p : offsets) {
            const std::size_t at = p.fields_ahead * count + first * p.field_size;
            if (get && p.in_field == 0) {
                begin = std::exchange(end, end + rows * p.field_size);
                get(at, std::span(held).subspan(begin, rows * p.field_size));
            }
            const char* const field =
                get ? reinterpret_cast<const char*>(held.data() + begin) : bytes->data() + at;
            places.push_back({field + p.in_field, p.field_size});
        }
        append_fixed_rows(vertices, points, rows, places, std::endian::little);
        if (bytes) bytes->release_memory();
        first += rows;
        return rows;
    };
}

[[nodiscard]] point_rows open(const source& in, scratch_place place, std::uint64_t first = 0,
                              const record_index* known = nullptr,
                              const byte_getter* unpacked = nullptr) {
    pcd_header header = read_pcd_header(in);
    point_rows rows;
    rows.count = header.vertices.rows;
    switch (header.encoding) {
        case pcd_encoding::ascii: {
            const auto at = known == nullptr ? record_index::mark{} : known->before(first);
            rows.append = text_runs(in, header, at, known);
            rows.left_out = at.record;
            break;
        }
        case pcd_encoding::binary:
            rows.append = row_runs(in, header, first);
            rows.left_out = first;
            break;
        case pcd_encoding::compressed:
            rows.append = block_runs(in, header, place, first, unpacked);
            rows.left_out = first;
            break;
    }
    rows.head.format = name_of(header.encoding);
    rows.head.stored_as = header.encoding != pcd_encoding::ascii && has_single_axes(header.vertices)
                              ? precision::float32
                              : precision::float64;
    rows.head.attributes = std::move(header.remarks);
    header.vertices.rows = 0;
    rows.head.attributes.elements = {std::move(header.vertices)};
    return rows;
}

}  // namespace

mesh_file read_pcd(const source& in) {
    mesh_file file = read_all(in, open(in, scratch_place::memory));
    file.stored_as = fits_float32(file.mesh.points) ? precision::float32 : precision::float64;
    return file;
}

point_rows open_pcd_points(const source& in, std::uint64_t first, const record_index* known,
                           const byte_getter* unpacked) {
    return open(in, scratch_place::file, first, known, unpacked);
}

std::optional<record_index> scan_pcd(const source& in, const file_part& part, std::size_t most) {
    const pcd_header header = read_pcd_header(in);
    if (header.encoding != pcd_encoding::ascii) return std::nullopt;
    return scan_rows(in, header.body, part, most);
}

}  // namespace treeform::detail::io
