#include "bench/near_pairs.hpp"

#include "bench/nary_nearness.hpp"
#include "support/random.hpp"
#include <libtree/paper/nary_search.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace treeform::bench {
namespace {

point3 random_in_cube(test::random& random, double low, double high) {
    const double x = random.in(low, high);
    const double y = random.in(low, high);
    return {x, y, random.in(low, high)};
}

/// Uniform on the unit sphere, with correctly rounded operations only.
point3 random_direction(test::random& random) {
    for (;;) {
        const point3 p = random_in_cube(random, -1, 1);
        const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        if (length > 0.1 && length <= 1) return {p.x / length, p.y / length, p.z / length};
    }
}

double squared_distance_of(const point3& a, const point3& b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

aabb<double, 3> box_about(const point3& p, double reach) {
    return {{p.x - reach, p.y - reach, p.z - reach}, {p.x + reach, p.y + reach, p.z + reach}};
}

}  // namespace

shared_cloud cloud_with_copies(std::size_t points, unsigned percent) {
    static std::pair<std::size_t, unsigned> known_as;
    static std::weak_ptr<const std::vector<point3>> known;
    if (const shared_cloud last = known.lock(); last && known_as == std::pair(points, percent))
        return last;
    test::random random(1);
    auto cloud = std::make_shared<std::vector<point3>>();
    const std::size_t copies = points * percent / 100;
    while (cloud->size() < points - copies) cloud->push_back(random_in_cube(random, 0, 1));
    while (cloud->size() < points) {
        const point3 p = (*cloud)[random.below(points - copies)];
        const point3 d = random_direction(random);
        cloud->push_back(
            {p.x + copy_distance * d.x, p.y + copy_distance * d.y, p.z + copy_distance * d.z});
    }
    random.shuffle(*cloud);
    known_as = {points, percent};
    known = cloud;
    return cloud;
}

std::size_t near_pair_count(const std::vector<point3>& points) {
    std::vector<point3> sorted = points;
    std::ranges::sort(sorted, {}, &point3::x);
    std::size_t count = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].x - sorted[i].x <= reach; ++j)
            count += squared_distance_of(sorted[i], sorted[j]) <= reach * reach;
    return count;
}

std::size_t count_of(const pair_lists& lists) {
    std::size_t count = 0;
    for (const auto& list : lists) count += list.size();
    return count;
}

tree<3> reach_tree(const std::vector<point3>& points) {
    return build(points, [](const point3& p) { return box_about(p, 0.5000001 * reach); });
}

pair_lists near_pairs(const tree<3>& tree, const std::vector<point3>& points) {
    using list = std::vector<id_pair>;
    return search_self<list>(tree, [&](list& found, std::uint32_t a, std::uint32_t b) {
        if (squared_distance_of(points[a], points[b]) <= reach * reach) found.emplace_back(a, b);
    });
}

nary_tree<double, 3> paper_point_tree(const std::vector<point3>& points) {
    return build(
        points, [](const point3& p) { return box_about(p, 0.0); }, tree_config{});
}

pair_lists near_pairs(const nary_tree<double, 3>& tree, const std::vector<point3>& points) {
    using list = std::vector<id_pair>;
    return search_self<list>(
        tree,
        [](const aabb<double, 3>& a, const aabb<double, 3>& b) {
            return squared_distance(a, b) <= reach * reach;
        },
        [&](list& found, std::uint32_t a, std::uint32_t b) {
            if (squared_distance_of(points[a], points[b]) <= reach * reach)
                found.emplace_back(a, b);
        });
}

}  // namespace treeform::bench
