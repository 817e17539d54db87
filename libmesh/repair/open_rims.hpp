#pragma once
/// \file
/// Where a surface ends.

#include <libmesh/repair/working_mesh.hpp>

#include <cstdint>
#include <vector>

namespace treeform::detail::repair {

/// A closed way of different points, at least three, in the direction in which the faces that fill
/// it will run.
struct open_rim {
    std::vector<std::uint32_t> points{};
    std::vector<std::uint32_t> faces{};  ///< at the edge from each point to the next: one that runs
                                         ///< against it
};

/// What rims run along.
enum class rim_edges : std::uint8_t {
    open,  ///< edges along which faces run more often one way than the other
    free   ///< edges of one face; what does not close along these alone is no rim
};

/// The rims of all holes: along them, faces run as often one way as the other.
///
/// An edge along which faces run more often one way than the other, by n, is in n rims. So rims are
/// there whatever the mesh, since all that faces leave over at a point goes on to another. A rim
/// goes on at the next open edge around its last point; where there are several fans, or crowded
/// edges, at the lowest open edge that is left. Rims are in the order of their lowest edges.
///
/// \cost O(V + F log F)
/// \same on any number of threads
[[nodiscard]] std::vector<open_rim> open_rims(const working_mesh& mesh,
                                              rim_edges along = rim_edges::open);

}  // namespace treeform::detail::repair
