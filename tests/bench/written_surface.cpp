#include "bench/written_surface.hpp"

#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace treeform::bench {
namespace {

struct edge_use {
    std::array<std::uint32_t, 2> ends;
    int way;
};

std::vector<edge_use> uses_of(const mesh& mesh) {
    std::vector<edge_use> uses;
    for (const face& f : mesh.faces)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(f[i], f[(i + 1) % 3]);
            if (low != high) uses.push_back({{low, high}, f[i] == low ? 1 : -1});
        }
    std::ranges::sort(uses, {}, &edge_use::ends);
    return uses;
}

}  // namespace

mesh as_written(mesh mesh, bool in_float) {
    if (!in_float) return mesh;
    for (point3& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto single = static_cast<float>(p[k]);
            p[k] = static_cast<double>(single);
        }
    return mesh;
}

surface_defects defects_of(const mesh& written) {
    const mesh joined = join_equal_points(written);
    surface_defects found;
    const face_pair_result pairs =
        self_intersections(joined, {.vertices = vertex_identity::by_index, .limit = 0});
    for (const std::uint64_t count : pairs.counts) found.intersections += count;
    for (const face& f : joined.faces)
        found.degenerate += f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
    const std::vector<edge_use> uses = uses_of(joined);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        int balance = 0;
        for (end = begin; end < uses.size() && uses[end].ends == uses[begin].ends; ++end)
            balance += uses[end].way;
        found.open_edges += balance != 0;
        found.crowded_edges += end - begin > 2;
    }
    return found;
}

}  // namespace treeform::bench
