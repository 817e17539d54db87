#pragma once
/// \file
/// Plans how points are stored in a LAS file: format, header, records, and the column of each
/// value.

#include <libmesh/io/las_dimensions.hpp>
#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/io/writers.hpp>
#include <libmesh/laz/chunk.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// The reason why a file cannot be written as LAS; the writer adds the name of the file.
class las_fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct las_plan {
    /// The header with the records to be written; its block has the length of the version.
    las_header header{};
    std::size_t record_size = 0;
    las_grid grid{};
    std::vector<las_dimension> dimensions{};
    /// [dimensions] number of the column among the data columns of "vertex" without lists; none:
    /// zeros.
    std::vector<std::optional<std::size_t>> column_of{};
    /// Return dimensions without a column, which are written as 1; empty if the file was LAS.
    std::vector<las_dimension> single_returns{};
    std::vector<laz::item> items{};  ///< for compressed points; empty: plain records
};

/// Number of points in a chunk of LAZ.
constexpr std::uint32_t laz_chunk = 50000;

/// Chooses scale and offset for these points.
void choose_las_grid(las_header& header, std::span<const point3> points,
                     const las_grid_wish& wish = {});

/// \throws std::invalid_argument for a scale or offset that is invalid in LAS
[[nodiscard]] las_grid_wish las_grid_wish_of(const write_options& options);

/// The integer whose coordinate is nearest to `x`, exactly `x` if possible. It may be beyond 32
/// bits.
[[nodiscard]] double nearest_step(const las_grid& grid, std::size_t axis, double x);
[[nodiscard]] inline bool is_las_step(double step) {
    return step >= std::numeric_limits<std::int32_t>::min() &&
           step <= std::numeric_limits<std::int32_t>::max();
}

/// Whether points have values that only formats from 6 on can store.
[[nodiscard]] bool has_extended_values(const element& vertices);
[[nodiscard]] bool is_extended(const las_header& header);
/// Changes the format to one of these, with all its dimensions.
void extend(las_header& header);

/// The plan for the job's file. `points` are all points; none if they will be written in blocks,
/// which requires that the file was LAS.
///
/// A file that was LAS keeps its version, format, scale and offset if they can store the columns;
/// other files get the smallest format for the columns, and the scales of `las_grid_choice`.
///
/// \throws las_fault
[[nodiscard]] las_plan plan_las(const write_job& job, std::optional<std::span<const point3>> points,
                                bool packed);

/// What of points is stored otherwise than it was to be.
struct las_changes {
    double moved = 0.0;        ///< the furthest that a coordinate is from the one to be written
    double rounded_by = 0.0;   ///< how far a value of extra bytes with a scale is from a step of it
    std::string rounded{};     ///< its column
    std::uint64_t wholes = 0;  ///< numbers that those with a point in the file do not hold
    std::vector<std::string> of_wholes{};  ///< columns that have such
    std::uint64_t without_value = 0;       ///< values that are no number, for which there is none

    void add(const las_changes& more);
    /// In words, except for `moved`.
    void remark(std::vector<io_warning>& warnings) const;
};

/// Bounds and counts of points that were written.
class las_tally {
  public:
    explicit las_tally(const las_plan& plan);

    /// Adds consecutive records.
    void add(const std::uint8_t* records, std::size_t count);

    /// Puts bounds and counts into the header. `count` is the number of points.
    void put(las_plan& plan, std::uint64_t count) const;

    las_changes changes{};

  private:
    std::size_t record_size_;
    unsigned return_bits_;  ///< 3 or 4
    std::uint64_t seen_ = 0;
    std::array<std::int32_t, 3> low_{};
    std::array<std::int32_t, 3> high_{};
    std::array<std::uint64_t, 16> by_return_{};
};

/// Some rows of points, and the room for their records.
struct record_rows {
    std::size_t first = 0;
    std::size_t count = 0;
    std::uint8_t* to = nullptr;
    std::size_t size = 0;  ///< of a record
};

/// Makes the records of some points and their columns; in parallel. `number` is that of the first
/// of them in the file, in errors.
///
/// \throws las_fault naming the lowest point whose coordinates or values the format does not hold
void put_records(std::span<const point3> points, const element* vertices, const las_plan& plan,
                 const record_rows& rows, std::uint64_t number, las_tally& tally);

}  // namespace treeform::detail::io
