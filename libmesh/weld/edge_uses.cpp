#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <algorithm>
#include <atomic>
#include <numeric>
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
    : at_(base::fill_lists<std::size_t, edge_use>(
          base::nameable_points(point_count), faces.size(),
          [&](std::size_t i, const auto& visit) {
              for_each_edge_of(faces[i], repeated, [&](std::uint32_t low, std::uint32_t high) {
                  visit(low, {high, static_cast<std::uint32_t>(i)});
              });
          },
          [](std::span<edge_use> uses) {
              const auto key = [](const edge_use& u) {
                  return std::uint64_t{u.high} << 32 | u.face;
              };
              std::sort(uses.begin(), uses.end(),
                        [&](const edge_use& u, const edge_use& v) { return key(u) < key(v); });
          })) {}

std::uint64_t count_nonmanifold_edges(std::size_t point_count, std::span<const face> faces) {
    const auto at = base::faces_at_lower_ends<std::size_t>(point_count, faces);
    constexpr std::size_t star_grain = std::size_t{1} << 10, few = 2;
    std::vector<std::uint64_t> found(chunk_count(at.end.size(), star_grain), 0);
    for_chunks(at.end.size(), star_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::vector<std::uint32_t> ends;  // of edges, the higher ones
        for (std::size_t v = begin; v < end; ++v) {
            if (at[v].size() <= few) continue;
            ends.clear();
            for (const std::uint32_t f : at[v])
                for (const std::uint32_t corner : faces[f])
                    if (corner > v) ends.push_back(corner);
            std::sort(ends.begin(), ends.end());
            for (std::size_t i = few; i < ends.size(); ++i)
                found[c] +=
                    ends[i] == ends[i - few] && (i == few || ends[i - few - 1] != ends[i]) ? 1 : 0;
        }
    });
    return std::accumulate(found.begin(), found.end(), std::uint64_t{0});
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
