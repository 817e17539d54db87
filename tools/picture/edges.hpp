#pragma once
/// \file
/// Lines of pages: where a surface ends.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tools {

using scene_segment = std::array<tf::point3, 2>;

/// Edges of one face. Those that are linked by points bound one hole, or border one sheet.
struct open_edges {
    std::vector<scene_segment> ends{};
    std::vector<std::uint32_t> hole{};  ///< [E] its number, from 0, in the order of first edges
    std::uint32_t holes = 0;
};

/// The edges of one face; points with equal coordinates are one.
///
/// \pre  coordinates of faces are finite
/// \cost O(V + F log F)
[[nodiscard]] open_edges find_open_edges(tf::mesh_view mesh);

}  // namespace tools
