#include <libmesh/io/detect.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace treeform::detail::io {
namespace {

[[nodiscard]] file_kind kind_of(const source& in, const std::filesystem::path& path,
                                const reading& how) {
    return detect(in, plain_extension(how.format), extension_of(path)).kind;
}

[[nodiscard]] point_rows open_rows(const source& in, const std::filesystem::path& path,
                                   const reading& how, std::uint64_t first, row_use use,
                                   const record_index* known, const byte_getter* unpacked) {
    using enum file_kind;
    const file_kind kind = kind_of(in, path, how);
    check_chosen_columns(in, how, kind);
    const std::string_view table = table_name(kind);
    if (!table.empty()) return open_xyz_points(in, table, first, known, how.options.columns);
    if (kind == ply) return open_ply_points(in, first, use, known);
    if (kind == stl_binary && use != row_use::none) return open_stl_points(in, first);
    if (kind == pcd) return open_pcd_points(in, first, known, unpacked);
    if (kind == las) return open_las_points(in, first);
    fail_in_blocks(in, kind == stl_binary
                           ? "corners of faces are no points that are read alone"
                           : "only PLY, PCD, LAS, LAZ, XYZ and CSV are read in blocks");
}

}  // namespace

record_index scan_rows(const source& in, const char* body, const file_part& part,
                       std::size_t most) {
    text rows(in);
    rows.at = body;
    text_scan scan(rows, part, most);
    bool hexadecimal = false;
    for (rows.skip_spaces(); !rows.done() && scan.is_in_part(); rows.skip_spaces()) {
        scan.add();
        for (; !rows.done() && !is_newline(*rows.at); ++rows.at)
            hexadecimal = hexadecimal || to_lower(*rows.at) == 'x';  // as 0x1.8p1
        in.release_before(rows.at);
    }
    record_index found = std::move(scan).found();
    found.hexadecimal = hexadecimal;
    return found;
}

mesh_file read_all(const source& in, point_rows rows) {
    if (rows.count > std::numeric_limits<std::uint32_t>::max())
        in.fail("more points than 32-bit numbers can name");
    mesh_file file = std::move(rows.head);
    element& vertices = file.attributes.elements[0];
    const auto count = static_cast<std::size_t>(rows.count);
    if (count <= in.size()) {  // else packed so well that the number is to be seen first
        start_columns(vertices, count);
        for (column& c : vertices.columns) prefer_large_pages(c.values.data(), c.values.capacity());
        reserve_large(file.mesh.points, count);
    }
    while (rows.append(file.mesh.points, vertices, count, file.warnings) > 0) continue;
    vertices.rows = file.mesh.points.size();
    return file;
}

point_blocks::point_blocks(const std::filesystem::path& path, const reading& how,
                           std::uint64_t first, row_use use, const record_index* known,
                           const byte_getter* unpacked)
    : in_(source::open(path, scratch_place::file)),
      rows_(open_rows(in_, path, how, first, use, known, unpacked)) {
    point_block block;
    constexpr std::uint64_t some = std::uint64_t{1} << 15;
    for (std::uint64_t left = first - rows_.left_out;
         left > 0 && read(block, static_cast<std::size_t>(std::min(left, some)));)
        left -= block.points.size();
}

bool point_blocks::read(point_block& block, std::size_t most) {
    const element* vertices = rows_.head.attributes.find("vertex");
    restart(block.properties, vertices == nullptr ? element{.name = "vertex"} : *vertices);
    block.points.clear();
    block.properties.rows = rows_.append(block.points, block.properties, most, rows_.head.warnings);
    return block.properties.rows > 0;
}

std::optional<record_index> scan_points(const std::filesystem::path& path, const reading& how,
                                        const file_part& part, std::size_t most, bool even) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;  // it is read once
    try {
        const source in = source::open(path);
        const file_kind kind = kind_of(in, path, how);
        const std::string_view table = table_name(kind);
        if (!table.empty()) return scan_xyz(in, table, part, most, even, how.options.columns);
        if (kind == file_kind::ply) return scan_ply(in, part, most);
        if (kind == file_kind::pcd) return scan_pcd(in, part, most);
    } catch (const io_error&) {  // which is said where it is opened
    }
    return std::nullopt;
}

bool has_listed_points_at(const std::filesystem::path& path, const reading& how) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    try {
        const source in = source::open(path);
        return kind_of(in, path, how) == file_kind::ply && has_listed_points(in);
    } catch (const io_error&) {
        return false;
    }
}

}  // namespace treeform::detail::io

namespace treeform {

struct point_reader::state {
    detail::io::point_blocks blocks;
};

point_reader::point_reader(const std::filesystem::path& path, std::string_view format,
                           std::uint64_t first, bool with_rows, const read_options& options)
    : state_(new state{{path,
                        {std::string(format), options},
                        first,
                        with_rows ? detail::io::row_use::copied : detail::io::row_use::none}}) {}
point_reader::~point_reader() = default;
point_reader::point_reader(point_reader&&) noexcept = default;
point_reader& point_reader::operator=(point_reader&&) noexcept = default;

const mesh_file& point_reader::header() const { return state_->blocks.header(); }
std::uint64_t point_reader::count() const { return state_->blocks.count(); }
bool point_reader::read(std::vector<point3>& points, element& properties, std::size_t most) {
    detail::io::point_block block{std::move(points), std::move(properties)};
    const bool some = state_->blocks.read(block, most);
    points = std::move(block.points);
    properties = std::move(block.properties);
    return some;
}
bool point_reader::read(row_block& block, std::size_t most) {
    return state_->blocks.read(block, most);
}

}  // namespace treeform
