#include <libmesh/round/near_edges.hpp>

#include <algorithm>
#include <cstdint>

namespace treeform::detail::round {

near_edges::near_edges(mesh_view surface, std::span<const std::uint32_t> faces)
    : faces_(faces), parts_(64) {
    for (auto& part : parts_) part.reserve(4 * faces.size() / parts_.size());
    for (std::uint32_t place = 0; place < faces.size(); ++place) {
        const face& f = surface.faces[faces[place]];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = f[i], b = f[i == 2 ? 0 : i + 1];
            const std::uint32_t low = std::min(a, b);
            const std::uint64_t edge = std::uint64_t{low} << 32 | std::max(a, b);
            parts_[low % parts_.size()].push_back({edge, place, a < b ? 1 : -1});
        }
    }
    for_chunks(parts_.size(), 1, [&](std::size_t part, std::size_t, std::size_t) {
        std::sort(parts_[part].begin(), parts_[part].end(), [](const use& x, const use& y) {
            return x.edge != y.edge ? x.edge < y.edge : x.place < y.place;
        });
    });
}

}  // namespace treeform::detail::round
