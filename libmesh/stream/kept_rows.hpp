#pragma once
/// \file
/// What is kept of groups of several points, where it is not simply the first of them; and the
/// numbers that points have when they are welded.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::stream {

/// Packs points with their properties into rows of numbers: three for the coordinates, then the
/// bytes of the columns.
class packed_points {
  public:
    explicit packed_points(const mesh_file& header);

    [[nodiscard]] std::size_t width() const { return width_; }
    void pack(const io::point_block& block, std::size_t point,
              std::vector<std::uint64_t>& to) const;
    void unpack(numbers from, io::point_block& block, std::size_t point) const;

    struct field {
        std::size_t column;
        std::size_t byte;  ///< position in the row
        scalar_type type;
    };
    [[nodiscard]] const std::vector<field>& fields() const { return fields_; }

  private:
    std::size_t width_ = 3;
    std::vector<field> fields_{};
};

/// The kept rows of groups of several points, ascending by the number of the group's first point.
/// Each rank has those of the first points assigned to it.
class kept_rows {
  public:
    /// Reads the points assigned to the process. Sets the longest move in `w` to that from the
    /// points to the kept rows. Collective: every rank must call this.
    kept_rows(cancellable_progress& pace, const work_folder& folder, const communicator& all,
              const tile_task& task, tile_steps& steps, tiles_welded& w);

    /// Sends the rows of all ranks to rank 0. \pre all points are assigned to it
    void gather_first(const tiles_welded& w);

    /// Whether the properties of the point are those of its group.
    [[nodiscard]] bool gives(std::uint64_t point) const { return givers_.keeps(point); }
    /// Number of points for which this is false, of those assigned to the process.
    [[nodiscard]] std::uint64_t dropped() const { return givers_.dropped(); }
    /// Whether float32 holds the coordinates of all rows exactly.
    [[nodiscard]] bool single() const { return single_; }

    /// Restarts at the first row.
    void rewind();
    /// Replaces a point of `block` by the next row.
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
    shared_sorter members_;  ///< rows of leader, number, key, and the packed point
    /// pairs of a group's first point and the point that gives its properties
    all_to_all changes_;
    kept_points givers_;
    bool single_ = true;
    bool has_all_;
    std::vector<record_count> counts_{};  ///< rows of each rank: leader, and the packed point
    std::optional<row_merge> next_{};
};

/// The number of a kept point in the written file, or that of the kept point of its group. Must be
/// requested one by one, from the first point assigned to the process on.
class new_numbers {
  public:
    /// Collective: every rank must call this, for its points.
    new_numbers(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                tile_steps& steps, tiles_welded& welded);

    [[nodiscard]] std::uint64_t of(std::uint64_t point);

  private:
    void ask_others(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                    const tile_steps& steps);

    tiles_welded& welded_;
    tile_steps::leaders leaders_;
    std::uint64_t before_ = 0;  ///< number of kept points of lower ranks
    /// with several ranks: dropped points and their numbers
    std::optional<row_merge> of_dropped_{};
};

}  // namespace treeform::detail::stream
