#pragma once
/// \file
/// What is to be known of a cloud before it is cut into tiles.

#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/pacer.hpp>
#include <libmesh/stream/state_record.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::stream {

struct point_survey {
    cloud_survey cloud{};
    std::vector<point3> sample{};  ///< finite points, all different
    double sample_share = 1.0;     ///< of all points
};

/// Points read at a time.
inline constexpr std::size_t points_a_block = std::size_t{1} << 15;

/// Reads the cloud once, in memory that does not depend on its size. \throws io_error, cancelled
[[nodiscard]] point_survey survey(joined_points& points, pacer& pace);

void store(const point_survey& survey, state_writer& state);
/// The sample is not among it.
[[nodiscard]] point_survey load_survey(state_reader& state);

}  // namespace treeform::detail::stream
