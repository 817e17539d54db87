#pragma once
/// \file
/// LAS point records from columns, and what a header says of all of them.

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
