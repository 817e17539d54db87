#pragma once
/// \file
/// Finds nodes of a face tree whose faces cannot intersect each other.

#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <span>

namespace treeform::detail::intersect {

/// Marks nodes of 4096, 512 or 64 faces that are height fields: no two of their faces meet beyond
/// corners and edges that they share by number. On a clean scan these are most nodes, and the test
/// costs a tenth of testing their pairs.
/// \pre `faces` are in leaf order; no coordinate is beyond `largest_filtered_coordinate`
[[nodiscard]] detail::node_marks<3> find_height_fields(points_view points,
                                                       std::span<const numbered_face> faces,
                                                       const tree<3>& tree);

}  // namespace treeform::detail::intersect
