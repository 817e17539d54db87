#pragma once
/// \file
/// How well two sides agree whatever their scale.

#include <libmesh/place/align_frame.hpp>
#include <libmesh/place/align_search.hpp>

#include <vector>

namespace treeform::detail::place {

/// Judges places of different scales. A cost of one direction alone is least where all points are
/// one, or where they are far larger than the fixed side: here a place is as good as the median
/// distance from the moving to the fixed points, in lengths of the moving side, times that from the
/// fixed to the moving ones, in those of the fixed side. Whichever side is the moving one, it is
/// the same.
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
