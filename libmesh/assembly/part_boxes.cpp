#include <libmesh/assembly/part_boxes.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail::assembly {
namespace {

aabb<double, 3> widened(const box3& box, double by) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    aabb<double, 3> wide;
    wide.include(box.min);
    wide.include(box.max);
    if (by == 0.0) return wide;
    for (std::size_t k = 0; k < 3; ++k) {
        wide.min[k] = std::nextafter(wide.min[k] - by, -infinity);
        wide.max[k] = std::nextafter(wide.max[k] + by, infinity);
    }
    return wide;
}

}  // namespace

std::vector<std::optional<box3>> boxes_of(std::span<const prepared_mesh> parts) {
    std::vector<std::optional<box3>> boxes(parts.size());
    for_chunks(parts.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) boxes[i] = place::box_of_faces(parts[i].view());
    });
    return boxes;
}

std::vector<part_pair> near_pairs(const std::vector<std::optional<box3>>& boxes, double distance) {
    std::vector<std::uint32_t> number;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i]) number.push_back(i);
    const tree<3> all = build(number, [&](std::uint32_t i) { return widened(*boxes[i], 0.0); });
    constexpr std::size_t grain = 64;
    std::vector<std::vector<part_pair>> found(chunk_count(number.size(), grain));
    for_chunks(number.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t i = number[n];
            search(all, widened(*boxes[i], distance), [&](std::uint32_t other) {
                const std::uint32_t j = number[other];
                if (j > i && place::within(*boxes[i], *boxes[j], distance))
                    found[chunk].push_back({i, j});
            });
        }
    });
    std::vector<part_pair> pairs;
    for (const auto& one : found) pairs.insert(pairs.end(), one.begin(), one.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<part_pair> sorted_pairs(const char* function, std::span<const part_pair> pairs,
                                    std::size_t count) {
    std::vector<part_pair> sorted;
    for (const auto& [a, b] : pairs) {
        if (std::max(a, b) >= count)
            throw std::invalid_argument(std::string("treeform::") + function +
                                        ": an ignored pair has part " +
                                        std::to_string(std::max(a, b)) + ", but there are " +
                                        std::to_string(count) + " parts");
        sorted.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    return sorted;
}

}  // namespace treeform::detail::assembly
