#pragma once
/// \file
/// What is to be known of a cloud before it is cut into tiles.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/state_record.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::stream {

struct point_survey {
    cloud_survey cloud{};
    struct part {
        std::vector<point3> points{};         ///< finite, all different
        std::vector<std::uint32_t> counts{};  ///< of equal ones, that each stands for; empty: of 1
        double share = 1.0;                   ///< of what it stands for
    };
    part sample{};  ///< of all points
    /// Of the cubes whose diagonal is the tolerance, a point in each: about what is kept. None
    /// where the tolerance was not known yet.
    std::optional<part> places{};
};

/// Points read at a time.
inline constexpr std::size_t points_a_block = std::size_t{1} << 15;

/// Reads the cloud once, each of `all` its share, in memory that does not depend on its size.
/// Samples have `most` points. All know all in the end.
/// \throws io_error, cancelled
[[nodiscard]] point_survey survey(joined_points& points, const communicator& all, const share& mine,
                                  std::optional<double> tolerance, std::size_t most,
                                  cancellable_progress& pace);

/// The number of the cube of a point, equal for those of one cube; with tolerance 0 of the point.
[[nodiscard]] std::uint64_t cube_of(const point3& p, double tolerance);

void store(const point_survey& survey, state_writer& state);
/// The sample is not among it.
[[nodiscard]] point_survey load_survey(state_reader& state);

}  // namespace treeform::detail::stream
