#pragma once
/// \file
/// Scale and offset of LAS for clouds that have none.

#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/pacer.hpp>
#include <libmesh/stream/team.hpp>

namespace treeform::detail::stream {

/// Those that `round_to_las` chooses for all points, of which each of the team reads its share twice,
/// or more often where the first ones have fewer digits than later ones.
/// \throws io_error, cancelled
[[nodiscard]] las_header las_grid_of(joined_points& points, const team& all, const share& mine,
                                     pacer& pace);

}  // namespace treeform::detail::stream
