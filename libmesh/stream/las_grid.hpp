#pragma once
/// \file
/// Scale and offset of LAS for clouds that have none.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>

#include <functional>

namespace treeform::detail::stream {

/// Gives the points of a process to what it is called with, some at a time.
using pass_of_points = std::function<void(const std::function<void(points_view)>&)>;

/// Those that `round_to_las` chooses for all points, those of each rank, in two passes or more.
[[nodiscard]] las_header las_grid_of(const pass_of_points& each, const communicator& all,
                                     const io::las_grid_wish& wish);

/// Those that `round_to_las` chooses for all points, of which each rank reads its share twice,
/// or more often where the first ones have fewer digits than later ones.
/// \throws io_error, cancelled
[[nodiscard]] las_header las_grid_of(joined_points& points, const communicator& all,
                                     const share& mine, cancellable_progress& pace,
                                     const io::las_grid_wish& wish);

}  // namespace treeform::detail::stream
