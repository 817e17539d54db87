#pragma once
/// \file
/// A measure of how well two sides agree that is independent of their scale.

#include <libmesh/place/align_frame.hpp>
#include <libmesh/place/align_search.hpp>

#include <vector>

namespace treeform::detail::place {

/// Compares alignments of different scales. A one-sided cost is least if the moving points collapse
/// to one point, or if they are far larger than the fixed side. This cost is a product: the median
/// distance from the moving to the fixed points, in lengths of the moving side, times the median
/// distance from the fixed to the moving points, in lengths of the fixed side. It is the same if
/// the sides are exchanged.
class both_ways {
  public:
    both_ways(const moving_points& few, const align_frame& frame, mesh_view fixed);

    [[nodiscard]] double cost_at(const search_task& task, const similarity& map) const;

  private:
    const moving_points& few_;
    searched_cloud moving_;
    std::vector<Vector3d> fixed_;
};

}  // namespace treeform::detail::place
