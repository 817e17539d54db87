#include <libmesh/io/detail/detect.hpp>
#include <libmesh/io/detail/extension.hpp>
#include <libmesh/io/detail/point_rows.hpp>
#include <libmesh/io/detail/vertex_columns.hpp>
#include <libmesh/io/point_stream.hpp>

#include <utility>

namespace tf {

namespace {

[[nodiscard]] detail::point_rows open_rows(const detail::source& in,
                                           const std::filesystem::path& path,
                                           std::string_view format) {
    const auto found =
        detail::detect(in, detail::plain_extension(format), detail::extension_of(path));
    switch (found.kind) {
        case detail::file_kind::ply:
            return detail::open_ply_points(in);
        case detail::file_kind::pcd:
            return detail::open_pcd_points(in);
        case detail::file_kind::xyz:
            return detail::open_xyz_points(in, "xyz");
        case detail::file_kind::csv:
            return detail::open_xyz_points(in, "csv");
        default:
            in.fail("only PLY, PCD, XYZ and CSV are read in blocks");
    }
}

}  // namespace

struct point_reader::state {
    detail::source in;  ///< ahead of what reads from it
    detail::point_rows rows{};
};

point_reader::point_reader(const std::filesystem::path& path, std::string_view format)
    : state_(new state{detail::source::open(path, detail::scratch_place::file)}) {
    state_->rows = open_rows(state_->in, path, format);
}
point_reader::~point_reader() = default;
point_reader::point_reader(point_reader&&) noexcept = default;
point_reader& point_reader::operator=(point_reader&&) noexcept = default;

const mesh_file& point_reader::header() const { return state_->rows.head; }

std::optional<std::uint64_t> point_reader::count() const { return state_->rows.count; }

bool point_reader::read(point_block& block, std::size_t most) {
    detail::point_rows& rows = state_->rows;
    const element* vertices = find_element(rows.head.attributes, "vertex");
    detail::restart(block.properties, vertices == nullptr ? element{.name = "vertex"} : *vertices);
    block.points.clear();
    block.properties.rows = rows.append(block.points, block.properties, most, rows.head.warnings);
    return block.properties.rows > 0;
}

}  // namespace tf
