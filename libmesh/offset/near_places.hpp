#pragma once
/// \file
/// Nearest points for many positions, with progress.

#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::offset {

/// `query.nearest` of `places`, block by block. An empty vector when cancelled.
[[nodiscard]] inline std::vector<std::optional<closest_point_result>> near_places(
    const nearness::closest_point_query& query, std::span<const point3> places,
    const progress_callback& progress) {
    constexpr std::size_t block = std::size_t{1} << 16;
    std::vector<std::optional<closest_point_result>> found;
    found.reserve(places.size());
    while (found.size() < places.size()) {
        const auto part = query.nearest(
            places.subspan(found.size(), std::min(block, places.size() - found.size())));
        found.insert(found.end(), part.begin(), part.end());
        if (progress &&
            !progress(static_cast<double>(found.size()) / static_cast<double>(places.size())))
            return {};
    }
    return found;
}

}  // namespace treeform::detail::offset
