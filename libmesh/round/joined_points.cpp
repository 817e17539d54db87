#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/round/joined_points.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace treeform::detail::round {

std::vector<std::uint32_t> joined_points(std::span<const point3> points,
                                         std::span<const std::uint32_t> near,
                                         std::span<const std::uint8_t> is_held, double reach) {
    const auto box_around = [&](std::uint32_t p, double by) {
        aabb<double, 3> box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = points[p][k] - by;
            box.max[k] = points[p][k] + by;
        }
        return box;
    };
    const auto distance = [&](std::uint32_t p, std::uint32_t q) {
        const point3 way = base::minus(points[p], points[q]);
        return std::sqrt(base::dot(way, way));
    };
    const dynamic_tree<3> tree(near, [&](std::uint32_t p) { return box_around(p, 0.0); });
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
    for (const std::uint32_t p : near)
        search(tree, box_around(p, reach), [&](std::uint32_t i) {
            const std::uint32_t q = near[i];
            if (p < q && distance(p, q) <= reach) pairs.emplace_back(distance(p, q), p, q);
        });
    std::ranges::sort(pairs);
    std::vector<std::uint32_t> now = base::numbers_below(points.size());
    const auto root = [&](std::uint32_t p) {
        while (now[p] != p) p = now[p] = now[now[p]];
        return p;
    };
    std::vector<double> radius(points.size(), 0.0);  // of what has become a point
    for (const auto& [length, p, q] : pairs) {
        std::uint32_t a = root(p), b = root(q);
        if (a == b || (is_held[a] != 0 && is_held[b] != 0)) continue;
        if (is_held[b] != 0 || (is_held[a] == 0 && b < a)) std::swap(a, b);
        const double moved = distance(a, b) + radius[b];
        if (moved > reach) continue;
        radius[a] = std::max(radius[a], moved);
        now[b] = a;
    }
    for (const std::uint32_t p : near) now[p] = root(p);
    return now;
}

}  // namespace treeform::detail::round
