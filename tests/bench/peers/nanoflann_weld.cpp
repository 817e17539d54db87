#include "bench/peers/nanoflann_weld.hpp"

#include "bench/peers/nanoflann_cloud.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace treeform::bench {
std::vector<std::uint32_t> nanoflann_weld(const std::vector<point3>& points, double tolerance) {
    const nanoflann_cloud given{points};
    nanoflann_index tree(3, given, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    nanoflann::SearchParams options;
    options.sorted = false;
    std::vector<std::uint32_t> leader_of(points.size());
    std::iota(leader_of.begin(), leader_of.end(), 0U);
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    std::vector<std::pair<std::uint32_t, double>> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (leader_of[i] != i) continue;
        const std::array<double, 3> query{points[i].x, points[i].y, points[i].z};
        // It finds what is nearer than the radius; the tolerance is to count as within.
        tree.radiusSearch(query.data(), tolerance * tolerance * (1.0 + 0x1p-50), found, options);
        for (const auto& [j, square] : found)
            if (j > i && square < distance[j]) {
                leader_of[j] = i;
                distance[j] = square;
            }
    }
    return leader_of;
}

}  // namespace treeform::bench
