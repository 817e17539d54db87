#include <libmesh/base/stars.hpp>
#include <libmesh/topology/is_manifold.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::topology {
namespace {

/// The corners of `f` after and before `point`.
std::array<std::uint32_t, 2> link_of(const face& f, std::uint32_t point) {
    const std::size_t i = f[0] == point ? 0 : f[1] == point ? 1 : 2;
    return {f[(i + 1) % 3], f[(i + 2) % 3]};
}

/// Whether the faces at a point are one closed fan: from one to the next across the edge that it
/// has in common with it alone, and so around all of them.
bool is_one_fan(std::span<const face> faces, std::span<const std::uint32_t> around,
                std::uint32_t point, std::vector<std::array<std::uint32_t, 2>>& links) {
    links.clear();
    for (const std::uint32_t f : around) links.push_back(link_of(faces[f], point));
    for (std::size_t i = 0; i + 1 < links.size(); ++i) {
        if (links[i][1] == links.front()[0]) return false;
        std::size_t following = 0;
        for (std::size_t j = i + 1; j < links.size(); ++j)
            if (links[j][0] == links[i][1]) following = following == 0 ? j : links.size();
        if (following == 0 || following == links.size()) return false;
        std::swap(links[i + 1], links[following]);
    }
    return links.empty() || links.back()[1] == links.front()[0];
}

}  // namespace

bool is_manifold(mesh_view mesh) {
    constexpr std::size_t many = 64;
    const base::stars stars(mesh.points.size(), mesh.faces);
    if (stars.face_count() != mesh.faces.size()) return false;
    std::atomic<bool> manifold{true};
    for_chunks(stars.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        std::vector<std::array<std::uint32_t, 2>> links;
        for (std::size_t v = begin; v < end && manifold.load(std::memory_order_relaxed); ++v)
            if (stars[v].size() > many ||
                !is_one_fan(mesh.faces, stars[v], static_cast<std::uint32_t>(v), links))
                manifold = false;
    });
    return manifold;
}

}  // namespace treeform::detail::topology
