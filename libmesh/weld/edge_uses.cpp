#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

template <class Body>
void for_each_edge_of(const face& f, repeated_corners repeated, const Body& body) {
    if (repeated == repeated_corners::left_out && !base::has_three_corners(f)) return;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(f[k], f[k == 2 ? 0 : k + 1]);
        if (low != high) body(low, high);
    }
}

}  // namespace

edge_uses::edge_uses(std::size_t point_count, std::span<const face> faces,
                     repeated_corners repeated)
    : at_(base::fill_lists<std::size_t, std::uint64_t>(
          base::nameable_points(point_count), faces.size(), [&](std::size_t i, const auto& visit) {
              for_each_edge_of(faces[i], repeated, [&](std::uint32_t low, std::uint32_t high) {
                  visit(low, std::uint64_t{high} << 32 | i);
              });
          })) {
    for_chunks(size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t v = begin; v < end; ++v)
            std::sort(at_.faces.data() + at_.end[v] - at_[v].size(), at_.faces.data() + at_.end[v]);
    });
}

std::uint64_t count_nonmanifold_edges(std::size_t point_count, std::span<const face> faces) {
    const edge_uses edges(point_count, faces, repeated_corners::left_out);
    std::vector<std::uint64_t> found(edges.chunks(), 0);
    edges.for_each([&](const used_edge& edge, std::size_t chunk) {
        if (edge.uses.size() > 2) ++found[chunk];
    });
    std::uint64_t total = 0;
    for (const std::uint64_t n : found) total += n;
    return total;
}

buffer<std::uint8_t> border_points(std::size_t point_count, std::span<const face> faces) {
    buffer<std::uint8_t> border(point_count);
    std::fill_n(border.data(), border.size(), std::uint8_t{0});
    // Any order of these stores leaves the same marks.
    const auto mark = [&](std::uint32_t v) {
        std::atomic_ref<std::uint8_t>(border[v]).store(1, std::memory_order_relaxed);
    };
    edge_uses(point_count, faces, repeated_corners::left_out)
        .for_each([&](const used_edge& edge, std::size_t) {
            if (edge.uses.size() != 1) return;
            mark(edge.low);
            mark(edge.high);
        });
    return border;
}

}  // namespace treeform::detail::weld
