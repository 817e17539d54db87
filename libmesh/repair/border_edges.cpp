#include <libmesh/repair/border_edges.hpp>
#include <libmesh/repair/working_mesh.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace treeform::detail::repair {

std::vector<border_edge> border_edges(std::size_t point_count, std::span<const face> faces) {
    const weld::edge_uses edges(point_count, faces, weld::repeated_corners::left_out);
    std::vector<std::vector<border_edge>> found(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        if (edge.uses.size() != 1) return;
        const std::uint32_t f = edge.face(0);
        if (runs_along(faces[f], edge.low, edge.high))
            found[chunk].push_back({edge.low, edge.high, f});
        else
            found[chunk].push_back({edge.high, edge.low, f});
    });
    std::vector<border_edge> all;
    for (const auto& part : found) std::ranges::copy(part, std::back_inserter(all));
    const auto place = [&](const border_edge& e) {
        const face& f = faces[e.face];
        return std::tuple(e.face, f[0] == e.from ? 0 : f[1] == e.from ? 1 : 2);
    };
    std::ranges::sort(all, {}, place);
    return all;
}

}  // namespace treeform::detail::repair
