#pragma once
/// \file
/// Finds the rims of holes.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

/// A closed sequence of at least three different points, in the direction of the faces that will
/// fill it.
struct open_rim {
    std::vector<std::uint32_t> points{};
    /// for the edge from each point to the next, a face that runs in the opposite direction
    std::vector<std::uint32_t> faces{};
};

/// The edges of which rims consist.
enum class rim_edges : std::uint8_t {
    open,  ///< edges whose signed face count is not zero
    free   ///< edges of one face; sequences that do not close along these are not rims
};

/// The rims of all holes: filling all of them balances every edge.
///
/// An edge with signed face count n is in |n| rims. Rims exist for any mesh, since the imbalances
/// of the edges at a point add up to 0. A rim continues at the next open edge around its last point
/// or, if there are several fans or edges of more than two faces, at the lowest remaining open
/// edge. Rims are in the order of their lowest edges.
///
/// \cost O(V + F log F)
/// \same on any number of threads
[[nodiscard]] std::vector<open_rim> open_rims(const working_mesh& mesh,
                                              rim_edges along = rim_edges::open);

}  // namespace treeform::detail::repair
