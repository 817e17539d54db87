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

#include <algorithm>
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

/// Bounds and counts of points that were written.
class las_tally {
  public:
    explicit las_tally(const las_plan& plan);

    /// Records that follow one another.
    void add(const std::uint8_t* records, std::size_t count);
    void moved(double by) {
        if (by > max_displacement_) max_displacement_ = by;
    }
    /// The furthest that a coordinate is from the one that was to be written.
    [[nodiscard]] double max_displacement() const { return max_displacement_; }

    /// A value of extra bytes with a scale that is no step of it, and how far it is from one.
    struct rounded_value {
        std::string column{};
        double by = 0.0;
    };
    void rounded(const rounded_value& value) {
        if (value.by > rounded_.by) rounded_ = value;
    }
    /// Whole numbers that the numbers with a point in the file do not hold, and of which columns.
    struct rounded_wholes {
        std::uint64_t count = 0;
        std::vector<std::string> columns{};

        void add(const rounded_wholes& more) {
            count += more.count;
            for (const std::string& name : more.columns)
                if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
        }
    };
    void rounded(const rounded_wholes& values) { wholes_.add(values); }
    void without_value(std::uint64_t count) { without_value_ += count; }
    /// What of values is other than it was to be, in words.
    void remark(std::vector<io_warning>& warnings) const;

    /// Puts bounds and counts into a header. `count` is the number of points.
    void put(std::vector<std::byte>& block, const las_grid& grid, std::uint64_t count,
             unsigned version_minor, unsigned format) const;

  private:
    std::size_t record_size_;
    unsigned return_bits_;  ///< 3 or 4
    double max_displacement_ = 0.0;
    rounded_value rounded_{};
    rounded_wholes wholes_{};
    std::uint64_t without_value_ = 0;
    std::uint64_t seen_ = 0;
    std::array<std::int32_t, 3> low_{};
    std::array<std::int32_t, 3> high_{};
    std::array<std::uint64_t, 16> by_return_{};
};

/// Some points and their columns.
class las_source {
  public:
    las_source(std::span<const point3> points, const element* vertices, const las_plan& plan);

    /// The records of `count` points from `first` on; in parallel. `number` is that of the first in
    /// the file, in errors.
    ///
    /// \throws las_fault naming the lowest point whose coordinates or values the format does not
    ///         hold
    void put(std::size_t first, std::size_t count, std::uint64_t number, std::uint8_t* records,
             las_tally& tally) const;

  private:
    std::span<const point3> points_;
    std::vector<const column*> columns_{};  ///< [dimensions]; null: zeros
    const las_plan& plan_;
};

}  // namespace treeform::detail::io
