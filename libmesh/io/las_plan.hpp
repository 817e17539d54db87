#pragma once
/// \file
/// How points will be stored in a LAS file: format, header, records, and the column of each value.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/io/las_rows.hpp>
#include <libmesh/io/writers.hpp>
#include <libmesh/laz/chunk.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace treeform::detail::io {

/// Why a file cannot be LAS; the writer adds the name of the file.
class las_fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct las_plan {
    /// With the records that will be written; its block is as long as that of the version.
    las_header header{};
    std::size_t record_size = 0;
    las_grid grid{};
    std::vector<las_dimension> dimensions{};
    /// [dimensions] number of the column among those of "vertex" that are data and no lists; none:
    /// zeros.
    std::vector<std::optional<std::size_t>> column_of{};
    /// Numbers of returns that no column has: 1 of 1, unless the file was LAS.
    std::vector<las_dimension> single_returns{};
    std::vector<laz::item> items{};  ///< of packed points; empty: plain records
};

/// Points of a chunk of LAZ.
constexpr std::uint32_t laz_chunk = 50000;

/// Scale and offset for these points, on each axis.
void choose_las_grid(las_header& header, std::span<const point3> points,
                     const las_grid_wish& wish = {});

/// \throws std::invalid_argument for a scale or offset that LAS has not
[[nodiscard]] las_grid_wish las_grid_wish_of(const write_options& options);

/// The whole number whose coordinate is nearest to `x`: the exact one, where there is one. It may
/// be beyond 32 bits.
[[nodiscard]] double nearest_step(const las_grid& grid, std::size_t axis, double x);
[[nodiscard]] inline bool is_las_step(double step) {
    return step >= std::numeric_limits<std::int32_t>::min() &&
           step <= std::numeric_limits<std::int32_t>::max();
}

/// Whether there are values of points that only formats from 6 on hold.
[[nodiscard]] bool has_extended_values(const element& vertices);
[[nodiscard]] bool is_extended(const las_header& header);
/// Makes the format one of these, with all that it has.
void extend(las_header& header);

/// The plan for the job's file. `points` are all of them; none when they will come by runs: then
/// the file must have been LAS.
///
/// A file that was LAS keeps its version, format, scale and offset, where the columns fit into it;
/// others get the smallest format that holds the columns, and scales as of `las_grid_choice`.
///
/// \throws las_fault
[[nodiscard]] las_plan plan_las(const write_job& job, std::optional<std::span<const point3>> points,
                                bool packed);

}  // namespace treeform::detail::io
