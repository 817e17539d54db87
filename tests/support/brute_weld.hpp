#pragma once
/// \file
/// The rules of welding as their definitions read: all pairs, one after the other.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>

#include <cstdint>
#include <numeric>
#include <vector>

namespace treeform::test {

/// Whether a and b are within `tolerance`. Rounded distances that differ by a part in 2^40 of a
/// number in the middle of the doubles' range need no look at the coordinates.
inline bool brute_within(const point3& a, const point3& b, double tolerance) {
    if (tolerance == 0.0) return a == b;
    const double x = a.x - b.x;
    const double y = a.y - b.y;
    const double z = a.z - b.z;
    const double square = x * x + y * y + z * z;
    const double limit = tolerance * tolerance;
    if (limit > 1e-200 && limit < 1e200) {
        if (square > limit * (1.0 + 0x1p-40)) return false;
        if (square < limit * (1.0 - 0x1p-40)) return true;
    }
    return compare_distance(a, b, {}, {tolerance, 0.0, 0.0}) <= 0;
}

/// Rule first: the kept point that each point belongs to; `linked(i, j)` says whether two are
/// within the tolerance and agree.
template <class Linked>
std::vector<std::uint32_t> brute_leaders(points_view points, const Linked& linked) {
    std::vector<std::uint32_t> leader(points.size());
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        leader[i] = i;
        for (const std::uint32_t k : kept) {
            if (!linked(i, k)) continue;
            if (leader[i] == i ||
                compare_distance(points[i], points[k], points[i], points[leader[i]]) < 0)
                leader[i] = k;
        }
        if (leader[i] == i) kept.push_back(i);
    }
    return leader;
}

/// Rule chain: the lowest point that each is linked to. Breadth first, through all pairs.
template <class Linked>
std::vector<std::uint32_t> brute_chains(points_view points, const Linked& linked) {
    std::vector<std::uint32_t> lowest(points.size());
    std::vector<std::uint32_t> left(points.size());  // points not met yet, ascending
    std::iota(left.begin(), left.end(), 0U);
    while (!left.empty()) {
        const std::uint32_t first = left.front();
        std::vector<std::uint32_t> met{first};
        left.erase(left.begin());
        for (std::size_t next = 0; next < met.size(); ++next) {
            const std::uint32_t from = met[next];
            lowest[from] = first;
            std::erase_if(left, [&](std::uint32_t i) {
                if (!linked(from, i)) return false;
                met.push_back(i);
                return true;
            });
        }
    }
    return lowest;
}

}  // namespace treeform::test
