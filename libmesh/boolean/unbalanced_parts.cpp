#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/unbalanced_parts.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <treeform/tree/detail/buffer.hpp>

namespace treeform::detail::boolean {

std::vector<std::uint8_t> find_unbalanced_parts(std::size_t point_count,
                                                std::span<const face> faces,
                                                std::span<const double> times) {
    std::vector<std::uint32_t> number;  // of those that are there
    std::vector<face> there;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (times[f] == 0.0) continue;
        number.push_back(f);
        const auto [a, b, c] = faces[f];
        there.push_back(times[f] > 0.0 ? face{a, b, c} : face{a, c, b});
    }
    const weld::edge_uses edges(point_count, there, weld::repeated_corners::left_out);
    base::union_find parts(there.size());
    std::vector<std::vector<std::uint32_t>> found(edges.chunks());
    edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
        double sum = 0.0;
        for (std::size_t i = 0; i < edge.uses.size(); ++i) {
            const auto [a, b, c] = there[edge.face(i)];
            const bool is_along = (a == edge.low && b == edge.high) ||
                                  (b == edge.low && c == edge.high) ||
                                  (c == edge.low && a == edge.high);
            const double own = times[number[edge.face(i)]];
            sum += (own < 0.0 ? -own : own) * (is_along ? 1.0 : -1.0);
        }
        for (std::size_t i = 1; i < edge.uses.size(); ++i) parts.join(edge.face(0), edge.face(i));
        if (sum != 0.0) found[chunk].push_back(edge.face(0));
    });
    const buffer<std::uint32_t> root = parts.take_roots();
    std::vector<std::uint8_t> is_unbalanced(there.size(), 0);
    for (const auto& some : found)
        for (const std::uint32_t f : some) is_unbalanced[root[f]] = 1;
    std::vector<std::uint8_t> result(faces.size(), 0);
    for (std::uint32_t f = 0; f < there.size(); ++f) result[number[f]] = is_unbalanced[root[f]];
    return result;
}

}  // namespace treeform::detail::boolean
