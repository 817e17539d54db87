#include <libmesh/base/compact.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/used_points.hpp>
#include <treeform/tree/parallel.hpp>

#include <atomic>

namespace treeform::detail::base {

std::vector<std::uint32_t> used_points(std::size_t point_count, std::span<const face> faces) {
    std::vector<std::uint8_t> used(point_count, 0);
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            for (const std::uint32_t corner : faces[f])
                std::atomic_ref(used[corner]).store(1, std::memory_order_relaxed);
    });
    std::vector<std::uint32_t> points;
    compact(
        point_count, [&](std::size_t p) { return used[p] != 0; },
        [&](std::size_t count) { resize_all(count, points); },
        [&](std::size_t p, std::size_t place) { points[place] = static_cast<std::uint32_t>(p); });
    return points;
}

}  // namespace treeform::detail::base
