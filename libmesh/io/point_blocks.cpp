#include <libmesh/io/detect.hpp>
#include <libmesh/io/extension.hpp>
#include <libmesh/io/point_blocks.hpp>
#include <libmesh/io/vertex_columns.hpp>

#include <algorithm>
#include <system_error>

namespace treeform::detail::io {
namespace {

[[nodiscard]] file_kind kind_of(const source& in, const std::filesystem::path& path,
                                const reading& how) {
    return detect(in, plain_extension(how.format), extension_of(path)).kind;
}

[[nodiscard]] point_rows open_rows(const source& in, const std::filesystem::path& path,
                                   const reading& how, std::uint64_t first, row_use use,
                                   const record_index* known, const byte_getter* unpacked) {
    const file_kind kind = kind_of(in, path, how);
    check_chosen_columns(in, how, kind);
    switch (kind) {
        case file_kind::ply:
            return open_ply_points(in, first, use, known);
        case file_kind::stl_binary:
            if (use != row_use::none) return open_stl_points(in, first);
            fail_in_blocks(in, "corners of faces are no points that are read alone");
        case file_kind::pcd:
            return open_pcd_points(in, first, known, unpacked);
        case file_kind::las:
            return open_las_points(in, first);
        case file_kind::xyz:
            return open_xyz_points(in, "xyz", first, known, how.options.columns);
        case file_kind::pts:
            return open_xyz_points(in, "pts", first, known, how.options.columns);
        case file_kind::csv:
            return open_xyz_points(in, "csv", first, known, how.options.columns);
        default:
            fail_in_blocks(in, "only PLY, PCD, LAS, LAZ, XYZ and CSV are read in blocks");
    }
}

}  // namespace

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
        switch (kind_of(in, path, how)) {
            case file_kind::ply:
                return scan_ply(in, part, most);
            case file_kind::pcd:
                return scan_pcd(in, part, most);
            case file_kind::xyz:
                return scan_xyz(in, "xyz", part, most, even, how.options.columns);
            case file_kind::pts:
                return scan_xyz(in, "pts", part, most, even, how.options.columns);
            case file_kind::csv:
                return scan_xyz(in, "csv", part, most, even, how.options.columns);
            default:
                return std::nullopt;
        }
    } catch (const io_error&) {
        return std::nullopt;
    }
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
