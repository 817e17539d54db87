#pragma once
/// \file
/// What is to be known of a cloud before it is cut into tiles, or written as LAS.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/record_file.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace treeform::detail::stream {

struct point_survey {
    cloud_survey cloud{};
    struct part {
        std::vector<point3> points{};  ///< finite and all different
        /// number of equal points that each represents; empty: 1
        std::vector<std::uint32_t> counts{};
        double share = 1.0;  ///< fraction of the points that the sample contains
    };
    part sample{};  ///< sample of all points
    /// A sample with one point in each cube whose diagonal is the tolerance: approximately the kept
    /// points. None if the tolerance was not known yet.
    std::optional<part> places{};
};

/// Number of points read at a time.
inline constexpr std::size_t points_a_block = std::size_t{1} << 15;

/// Reads the cloud once, each rank its share, with memory independent of its size. Samples have at
/// most `most` points. All ranks get the result for the whole cloud.
/// \throws io_error, cancelled
[[nodiscard]] point_survey survey(joined_points& points, const communicator& all, const share& mine,
                                  std::optional<double> tolerance, std::size_t most,
                                  cancellable_progress& pace);

/// A number equal for points in the same cube; with tolerance 0, for equal points.
[[nodiscard]] std::uint64_t cube_of(const point3& p, double tolerance);

void store(const point_survey& survey, state_writer& state);
/// Loads a survey, without the sample.
[[nodiscard]] point_survey load_survey(state_reader& state);

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
