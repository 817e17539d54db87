#pragma once
/// \file
/// What is kept of groups of several points, where it is not simply the first of them.

#include <libmesh/stream/all_to_all.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::stream {

/// Points with their properties as rows of numbers: three for the coordinates, then the bytes of
/// the columns.
class packed_points {
  public:
    explicit packed_points(const mesh_file& header);

    [[nodiscard]] std::size_t width() const { return width_; }
    void pack(const io::point_block& block, std::size_t point,
              std::vector<std::uint64_t>& to) const;
    void unpack(numbers from, io::point_block& block, std::size_t point) const;

    struct field {
        std::size_t column;
        std::size_t byte;  ///< in the row
        scalar_type type;
    };
    [[nodiscard]] const std::vector<field>& fields() const { return fields_; }

  private:
    std::size_t width_ = 3;
    std::vector<field> fields_{};
};

/// The rows that stand for the groups of several points, by ascending number of their first. Of
/// several ranks, each has those of the first points that are assigned to it.
class kept_rows {
  public:
    /// Reads the points that are assigned to the process. Replaces the longest move of `w` by that
    /// to what is kept. Collective: every rank must call this.
    kept_rows(cancellable_progress& pace, const work_folder& folder, const communicator& all,
              const tile_task& task, tile_steps& steps, tiles_welded& w);

    /// Rank 0 gets the rows of all. \pre all points are assigned to it
    void gather_first(const tiles_welded& w);

    /// Whether the point gives its properties to what is kept.
    [[nodiscard]] bool gives(std::uint64_t point) const { return givers_.keeps(point); }
    /// Points that do not, of those that are assigned to the process.
    [[nodiscard]] std::uint64_t dropped() const { return givers_.dropped(); }
    /// Whether float32 holds the coordinates of all rows.
    [[nodiscard]] bool single() const { return single_; }

    /// From the first row again.
    void rewind();
    /// Puts the next row in the place of a point of `block`.
    void replace(io::point_block& block, std::size_t point);

  private:
    void gather(cancellable_progress& pace, tile_steps& steps, const tiles_welded& w);
    void choose(cancellable_progress& pace);
    void send_to_givers();
    void share_rows(const record_count& mine);
    [[nodiscard]] double longest_move(cancellable_progress& pace);
    [[nodiscard]] std::size_t owner_of(std::uint64_t point) const {
        return all_.owner_of(point, points_);
    }
    [[nodiscard]] std::filesystem::path path(std::size_t rank) const;

    const work_folder& folder_;
    const communicator& all_;
    weld_keep keep_;
    std::uint64_t points_;
    packed_points packed_;
    shared_sorter members_;  ///< leader, number, key, and the packed point
    all_to_all changes_;     ///< first points of groups, and those that give instead
    kept_points givers_;
    bool single_ = true;
    bool has_all_;
    std::vector<record_count> counts_{};  ///< of the rows of each: leader, and the packed point
    std::optional<row_merge> next_{};
};

}  // namespace treeform::detail::stream
