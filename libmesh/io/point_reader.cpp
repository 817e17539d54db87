#include <libmesh/io/detect.hpp>
#include <libmesh/io/extension.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <algorithm>
#include <utility>

namespace treeform {

namespace {

[[nodiscard]] detail::io::point_rows open_rows(const detail::io::source& in,
                                               const std::filesystem::path& path,
                                               std::string_view format, std::uint64_t first,
                                               bool with_rows) {
    const auto found =
        detail::io::detect(in, detail::io::plain_extension(format), detail::io::extension_of(path));
    switch (found.kind) {
        case detail::io::file_kind::ply:
            return detail::io::open_ply_points(in, first, with_rows);
        case detail::io::file_kind::stl_binary:
            if (with_rows) return detail::io::open_stl_points(in, first);
            in.fail("corners of faces are no points that are read alone");
        case detail::io::file_kind::pcd:
            return detail::io::open_pcd_points(in, first);
        case detail::io::file_kind::las:
            return detail::io::open_las_points(in, first);
        case detail::io::file_kind::xyz:
            return detail::io::open_xyz_points(in, "xyz");
        case detail::io::file_kind::pts:
            return detail::io::open_xyz_points(in, "pts");
        case detail::io::file_kind::csv:
            return detail::io::open_xyz_points(in, "csv");
        default:
            in.fail("only PLY, PCD, LAS, LAZ, XYZ and CSV are read in blocks");
    }
}

}  // namespace

struct point_reader::state {
    detail::io::source in;  ///< ahead of what reads from it
    detail::io::point_rows rows{};
};

point_reader::point_reader(const std::filesystem::path& path, std::string_view format,
                           std::uint64_t first, bool with_rows)
    : state_(new state{detail::io::source::open(path, detail::io::scratch_place::file)}) {
    state_->rows = open_rows(state_->in, path, format, first, with_rows);
    point_block block;
    constexpr std::uint64_t some = std::uint64_t{1} << 15;
    for (std::uint64_t left = first - state_->rows.left_out;
         left > 0 && read(block, static_cast<std::size_t>(std::min(left, some)));)
        left -= block.points.size();
}
point_reader::~point_reader() = default;
point_reader::point_reader(point_reader&&) noexcept = default;
point_reader& point_reader::operator=(point_reader&&) noexcept = default;

const mesh_file& point_reader::header() const { return state_->rows.head; }

std::optional<std::uint64_t> point_reader::count() const { return state_->rows.count; }

bool point_reader::read(point_block& block, std::size_t most) {
    detail::io::point_rows& rows = state_->rows;
    const element* vertices = find_element(rows.head.attributes, "vertex");
    detail::io::restart(block.properties,
                        vertices == nullptr ? element{.name = "vertex"} : *vertices);
    block.points.clear();
    block.properties.rows = rows.append(block.points, block.properties, most, rows.head.warnings);
    return block.properties.rows > 0;
}

bool point_reader::read(row_block& block, std::size_t most) {
    detail::io::point_rows& rows = state_->rows;
    return rows.behind && rows.behind(block, most, rows.head.warnings);
}

row_place point_reader::next_row() {
    return state_->rows.next_row ? state_->rows.next_row() : row_place{};
}

void point_reader::go_to(const row_place& place) {
    if (state_->rows.go_to) state_->rows.go_to(place);
}

std::vector<row_place> point_reader::row_parts(std::size_t count) {
    return state_->rows.row_parts ? state_->rows.row_parts(count) : std::vector<row_place>();
}

}  // namespace treeform
