#include <libmesh/repair/tangle.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace treeform::detail::repair {

bool is_hopeless(const edge_tally& tally, std::size_t face_count) {
    constexpr std::uint64_t most = 10;  // faces for each such edge
    const std::uint64_t simple = std::min(tally.unbalanced, tally.border + tally.misoriented);
    return most * (tally.unbalanced - simple) > face_count && face_count > 1000;
}

bool is_tangle(mesh_view mesh, double most, const progress_callback& progress) {
    const auto found = self_intersections(
        mesh, {.vertices = vertex_identity::by_index, .limit = 0, .progress = progress});
    const std::uint64_t pairs =
        std::accumulate(found.counts.begin(), found.counts.end(), std::uint64_t{0});
    return found.status != treeform::status::cancelled &&
           static_cast<double>(pairs) > most * static_cast<double>(mesh.faces.size());
}

}  // namespace treeform::detail::repair
