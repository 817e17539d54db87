#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/stream/leading_points.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::uint64_t held_bytes = std::uint64_t{1} << 22;

/// Points that are to be filled in.
io::point_block block_like(const mesh_file& header, std::size_t points) {
    io::point_block block;
    block.points.resize(points);
    if (const element* const vertices = header.attributes.find("vertex"))
        block.properties = *vertices;
    io::resize_columns(block.properties, points);
    return block;
}

}  // namespace

leading_points::leading_points(const work_folder& folder, const communicator& all,
                               const std::string& name, const mesh_file& header, std::uint64_t mine,
                               std::uint64_t together)
    : header_(header), packed_(header), exchanged_(folder, all, name, packed_.width(), held_bytes) {
    state_writer sent;
    sent.number(mine);
    std::vector<std::uint64_t> parts;  // where they begin
    std::uint64_t before = 0;
    std::uint64_t first = 0;
    for (state_reader& one : all.exchange(sent)) {
        if (parts.size() == all.rank()) first = before;
        parts.push_back((before + together - 1) / together * together);
        before += one.number();
    }
    left_ = std::min(parts[all.rank()] - first, mine);
    to_ = static_cast<std::size_t>(std::upper_bound(parts.begin(), parts.end(), first) -
                                   parts.begin() - 1);
}

void leading_points::take_off(io::point_block& block) {
    const auto some =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(left_, block.points.size()));
    if (some == 0) return;
    for (std::uint32_t i = 0; i < some; ++i) {
        row_.clear();
        packed_.pack(block, i, row_);
        exchanged_.put(to_, row_);
    }
    left_ -= some;
    std::vector<std::uint32_t> rest(block.points.size() - some);
    std::iota(rest.begin(), rest.end(), some);
    block.points.erase(block.points.begin(), block.points.begin() + some);
    block.properties = block.properties.gathered(rest);
}

void leading_points::give(const std::function<void(const io::point_block&)>& write) {
    exchanged_.send();
    for (row_reader& from : exchanged_.received())
        while (!from.empty()) {
            std::vector<std::uint64_t> rows;
            const std::size_t most = points_a_block * packed_.width();
            for (; !from.empty() && rows.size() < most; from.pop())
                rows.insert(rows.end(), from.front().begin(), from.front().end());
            io::point_block block = block_like(header_, rows.size() / packed_.width());
            for (std::size_t i = 0; i < block.points.size(); ++i)
                packed_.unpack(numbers(rows).subspan(i * packed_.width(), packed_.width()), block,
                               i);
            write(block);
        }
    exchanged_.remove_received();
}

}  // namespace treeform::detail::stream
