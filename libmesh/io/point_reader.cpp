#include <libmesh/io/point_blocks.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <string>
#include <utility>
#include <vector>

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
bool point_reader::read(detail::io::row_block& block, std::size_t most) {
    return state_->blocks.read(block, most);
}

}  // namespace treeform
