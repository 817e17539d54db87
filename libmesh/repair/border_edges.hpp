#pragma once
/// \file
/// The edges of exactly one face.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::repair {

/// Directed as in its face.
struct border_edge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t face;
};

/// The border edges, ascending by face, then in the order of its corners.
///
/// \pre  every corner is less than `point_count`
/// \same on any number of threads
[[nodiscard]] std::vector<border_edge> border_edges(std::size_t point_count,
                                                    std::span<const face> faces);

}  // namespace treeform::detail::repair
