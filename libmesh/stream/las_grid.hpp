#pragma once
/// \file
/// Chooses LAS scale and offset for clouds that have none.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>

#include <functional>

namespace treeform::detail::stream {

/// Calls its argument with the points of the process, block by block.
using pass_of_points = std::function<void(const std::function<void(points_view)>&)>;

/// The scale and offset that `round_to_las` chooses for the points of all ranks, in two passes or
/// more.
[[nodiscard]] las_header las_grid_of(const pass_of_points& each, const communicator& all,
                                     const io::las_grid_wish& wish);

/// The same for `points`, of which each rank reads its share twice, or more often if the first
/// points have fewer digits than later ones.
/// \throws io_error, cancelled
[[nodiscard]] las_header las_grid_of(joined_points& points, const communicator& all,
                                     const share& mine, cancellable_progress& pace,
                                     const io::las_grid_wish& wish);

}  // namespace treeform::detail::stream
