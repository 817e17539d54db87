#include <libmesh/base/point_math.hpp>
#include <libmesh/weld/near_pairs.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace treeform::detail::weld {

bool pairs_by_tree(const near_pairs_task& task) {
    constexpr double big = std::numeric_limits<double>::infinity();
    constexpr std::uint64_t patience = 64;  // candidates a point
    std::vector<std::uint32_t> finite;
    for (std::uint32_t i = 0; i < task.points.size(); ++i)
        if (base::is_finite(task.points[i])) finite.push_back(i);
    // Boxes of points within the tolerance overlap: half of it, rounded up, on each side.
    const double half = std::nextafter(0.5 * task.tolerance, big);
    bool bounded = true;
    for (const std::uint32_t i : finite) {
        const point3& p = task.points[i];
        const double largest = base::largest_of(p);
        bounded = bounded && largest < 0x1p1022 && half < 0x1p1022;
    }
    if (!bounded) return false;
    const auto tree = build(finite, [&](std::uint32_t i) {
        const point3& p = task.points[i];
        aabb<double, 3> box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::nextafter(p[k] - half, -big);
            box.max[k] = std::nextafter(p[k] + half, big);
        }
        return box;
    });

    const self_search<3> search(tree);
    const std::uint64_t most = patience * (finite.size() + 1024);
    std::atomic<std::uint64_t> taken = 0;
    std::atomic<bool> stopped = false;
    for_chunks(search.chunks(), 1, [&](std::size_t chunk, std::size_t, std::size_t) {
        if (stopped.load(std::memory_order_relaxed)) return;
        pair_collector found(task);
        const auto visit = [&](const candidate_block& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                if (!found.add(finite[tree.ids()[block.first[i]]],
                               finite[tree.ids()[block.second[i]]], lattice::verdict::unsure))
                    stopped.store(true, std::memory_order_relaxed);
            if (taken.fetch_add(block.first.size(), std::memory_order_relaxed) > most)
                stopped.store(true, std::memory_order_relaxed);
            return !stopped.load(std::memory_order_relaxed);
        };
        static_cast<void>(search.visit(chunk, visit));
        if (!found.flush()) stopped.store(true, std::memory_order_relaxed);
    });
    return !stopped;
}

}  // namespace treeform::detail::weld
