#pragma once
/// \file
/// Makes LAS point records from columns, and collects bounds and counts for the header.

#include <libmesh/io/las_plan.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// Bounds and counts of points that were written.
class las_tally {
  public:
    explicit las_tally(const las_plan& plan);

    /// Adds consecutive records.
    void add(const std::uint8_t* records, std::size_t count);
    void moved(double by) {
        if (by > max_displacement_) max_displacement_ = by;
    }
    /// The largest change of a coordinate.
    [[nodiscard]] double max_displacement() const { return max_displacement_; }

    /// A column of scaled extra bytes, and the largest change of its values by rounding to the
    /// scale.
    struct rounded_value {
        std::string column{};
        double by = 0.0;
    };
    void rounded(const rounded_value& value) {
        if (value.by > rounded_.by) rounded_ = value;
    }
    /// Number of integers that the file's floating-point types cannot represent, and their columns.
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
    /// Adds warnings about changed values.
    void remark(std::vector<io_warning>& warnings) const;

    /// Writes bounds and counts into a header block. `count` is the number of points.
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

/// Points and their columns, as LAS records.
class las_source {
  public:
    las_source(std::span<const point3> points, const element* vertices, const las_plan& plan);

    /// Writes the records of `count` points from `first` on, in parallel. `number` is that of the
    /// first point in the file, for errors.
    ///
    /// \throws las_fault naming the lowest point whose coordinates or values the format cannot
    ///         store
    void put(std::size_t first, std::size_t count, std::uint64_t number, std::uint8_t* records,
             las_tally& tally) const;

  private:
    std::span<const point3> points_;
    std::vector<const column*> columns_{};  ///< [dimensions]; null: zeros
    const las_plan& plan_;
};

}  // namespace treeform::detail::io
