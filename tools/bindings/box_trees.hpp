#pragma once
/// \file
/// Searches in trees of boxes for both languages, with results in rows and lists.

#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness_batch.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace tools {

/// Boxes with these lower and upper corners. `build` and `search_all` report invalid ones.
template <std::size_t D>
std::vector<treeform::aabb<double, D>> boxes_of(std::span<const std::array<double, D>> lows,
                                                std::span<const std::array<double, D>> highs) {
    std::vector<treeform::aabb<double, D>> boxes(lows.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = {lows[i], highs[i]};
    return boxes;
}

template <std::size_t D>
struct boxes_and_tree {
    using box = treeform::aabb<double, D>;

    explicit boxes_and_tree(std::vector<box> of)
        : boxes(std::move(of)), tree(treeform::build(boxes, std::identity{})) {}

    /// The boxes that overlap `query`, ascending.
    [[nodiscard]] std::vector<std::uint32_t> overlapping(const box& query) const {
        return treeform::search_all(
            tree, query, [&](std::uint32_t i) { return treeform::overlaps(boxes[i], query); });
    }

    [[nodiscard]] auto nearest(std::span<const std::array<double, D>> points, std::size_t k,
                               double radius) const {
        const auto squared = [&](std::size_t query, std::uint32_t i) {
            return treeform::squared_distance(boxes[i], points[query]);
        };
        return treeform::k_nearest_batch(tree, points, k, squared, radius);
    }

    std::vector<box> boxes;
    treeform::tree<D> tree;
};

/// Appends the lists `list_of(i)` for i from `begin` to `end` to [begin, ids]. Parallel.
template <class Id, class Begin, class ListOf>
void append_lists(std::size_t begin, std::size_t end, std::vector<Begin>& begins,
                  std::vector<Id>& ids, const ListOf& list_of) {
    std::vector<std::vector<std::uint32_t>> lists(end - begin);
    treeform::for_chunks(lists.size(), 64, [&](std::size_t from, std::size_t to, std::size_t) {
        for (std::size_t i = from; i < to; ++i) lists[i] = list_of(begin + i);
    });
    for (const auto& one : lists) {
        ids.insert(ids.end(), one.begin(), one.end());
        begins.push_back(static_cast<Begin>(ids.size()));
    }
}

/// Fills rows of k ids and distances, either of which may be null, from query `begin` on. If there
/// are fewer neighbors, or if `distance_of(neighbor)` is NaN, ids are `none` and distances
/// infinite.
template <class Id, class Lists, class DistanceOf>
void fill_rows(const Lists& found, std::size_t begin, std::size_t k, Id* ids, double* distances,
               Id none, const DistanceOf& distance_of) {
    for (std::size_t query = 0; query < found.size(); ++query) {
        const auto row = found[query];
        for (std::size_t i = 0; i < k; ++i) {
            const std::size_t at = (begin + query) * k + i;
            const double distance = i < row.size() ? distance_of(row[i]) : std::nan("");
            const bool there = !std::isnan(distance);
            if (ids) ids[at] = there ? static_cast<Id>(row[i].id) : none;
            if (distances)
                distances[at] = there ? distance : std::numeric_limits<double>::infinity();
        }
    }
}

}  // namespace tools
