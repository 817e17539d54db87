#pragma once
/// \file
/// Welds a cloud in tiles on the disk, in steps. Steps are idempotent; a restart skips finished
/// ones.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/point_keys.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <libmesh/weld/tile_cuts.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

using weld::asked_point;
using weld::border_kind;
using weld::border_point;

/// The rows that tiles leave to the border pass. A row has five numbers, namely the tag of a point,
/// its coordinates and one more number, then the values of the point. A point with a leader has a
/// second row, with the coordinates of the leader.
inline constexpr std::size_t border_numbers = 5;
using border_row = std::array<std::uint64_t, border_numbers>;

[[nodiscard]] inline border_row row_of(std::uint64_t tag, const point3& p, std::uint64_t more) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return {tag, bits(p.x), bits(p.y), bits(p.z), more};
}
[[nodiscard]] inline border_row row_of(const asked_point& a) {
    return row_of(a.bundle, a.at, a.asked_by);
}

[[nodiscard]] inline point3 point_of(numbers row) {
    const auto at = [&](std::size_t k) { return std::bit_cast<double>(row[k]); };
    return {at(1), at(2), at(3)};
}
[[nodiscard]] inline asked_point asked_of(numbers row) { return {row[0], point_of(row), row[4]}; }

[[nodiscard]] inline bool has_leader(const border_point& b) {
    return b.kind() == border_kind::provisional || b.kind() == border_kind::link;
}

/// Writes the rows of a point, and returns their number.
inline std::uint64_t put_rows(const border_point& b, numbers values, row_writer& to) {
    to.put(row_of(b.tag, b.at, b.leader));
    to.put(values);
    if (!has_leader(b)) return 1;
    to.put(row_of(b.tag, b.leader_at, 0));
    to.put(values);
    return 2;
}

/// Reads the point at the front, and advances to its last row. \pre not empty
template <class Rows>  // row_reader or row_merge
[[nodiscard]] border_point take_rows(Rows& rows) {
    const numbers row = rows.front();
    border_point b{row[0], point_of(row), row[4], {}};
    if (!has_leader(b)) return b;
    rows.pop();
    b.leader_at = point_of(rows.front());
    return b;
}

using weld::border_weld;
using weld::longest_move;
using weld::tile_cuts;
using weld::tile_drop;
using weld::tile_member;
using weld::tile_point;
using weld::tile_role;

/// Memory needed for an empty cloud: the program, its threads and its buffers.
inline constexpr std::uint64_t base_memory = std::uint64_t{32} << 20;
/// The memory available for points, in a process limited to `memory`; and the inverse.
[[nodiscard]] inline std::uint64_t left_for_points(std::uint64_t memory) {
    return memory - std::min(base_memory, memory / 2);
}
[[nodiscard]] inline std::uint64_t memory_with(std::uint64_t for_points) {
    return for_points + std::min(base_memory, for_points);
}

struct tile_task {
    cloud_inputs inputs{};
    weld_stream_options options{};  ///< `memory` is the memory available for points
    std::string identity{};    ///< identifies the job; earlier work is reused only if it is equal
    std::uint64_t memory = 0;  ///< limit of the process
};

/// The outcome of welding the tiles and their borders.
struct tiles_welded {
    tiles_welded(double tolerance, const weld::agreement& agree) : border(tolerance, agree) {}

    share points{};       ///< the points assigned to the process
    kept_points kept{0};  ///< the kept ones of these, by number in the files
    /// points "dropped" in it are kept points with others in their group, if requested
    std::optional<kept_points> followed{};
    border_weld border;         ///< finds the leaders of points
    std::uint64_t dropped = 0;  ///< of all points; so are the next two
    std::uint64_t groups = 0;
    double max_displacement = 0.0;
    struct file {
        std::filesystem::path path{};
        record_count count{};
    };
    std::vector<file> drops{};  ///< files of drops assigned to the process
    /// With several ranks: [a][b] files of points that rank a sends to rank b.
    std::vector<std::vector<file>> sent{};
};

/// Tiles and borders identify points by their rank in the order in which the rule visits them.
/// Without `order_by`, the rank of a point is its number.
class tile_steps {
  public:
    tile_steps(cancellable_progress& pace, const work_folder& folder, const tile_task& task,
               const communicator& all, joined_points& source, const point_keys& keys);

    /// Reads the cloud once, or loads the survey of an earlier run, which is then continued. Then
    /// plans the tiles.
    void take_survey();
    /// Unpacks compressed PCD inputs, once. Collective: every rank must call this.
    void unpack();
    [[nodiscard]] const cloud_survey& survey() const { return survey_.cloud; }
    /// For adding data about other elements than points.
    [[nodiscard]] cloud_survey& survey() { return survey_.cloud; }
    /// Whether the points of tiles were written, by this or another process. Does not check the
    /// files.
    [[nodiscard]] bool has_tiles() { return scattered_ || find_plan(); }
    /// Whether the folder has tiles, even of another cloud or other options.
    [[nodiscard]] bool has_plan() const;
    /// Reads the cloud again, and writes the points of each tile.
    void scatter();
    /// Welds the tiles that are not finished.
    void weld_tiles();
    /// Welds a tile, unless it is finished. Two processes that weld the same tile write the same
    /// bytes.
    void weld_one(std::size_t tile);
    [[nodiscard]] std::size_t tiles() const { return tiles_.size(); }
    [[nodiscard]] std::vector<std::size_t> unfinished();
    /// \throws io_error naming the tiles that are not finished
    void check_finished();
    /// \throws io_error with the memory that would suffice, if there is not enough
    void check_before_borders() const;
    [[nodiscard]] tiles_welded weld_borders();
    /// Assigns all points to rank 0.
    void gather_first(tiles_welded& w) const;

    /// The kept point of each point's group; must be requested one by one, from the first point on.
    class leaders {
      public:
        /// Collective: every rank must call this, for its points.
        leaders(const tile_steps& steps, const communicator& all, const tiles_welded& welded);
        leaders(const tile_steps& steps, const tiles_welded& welded)
            : leaders(steps, steps.all(), welded) {}
        [[nodiscard]] std::uint64_t of(std::uint64_t point);

      private:
        void number(const tile_steps& steps, const communicator& all, const share& assigned,
                    row_merge& ranks);

        const border_weld& border_;
        std::unique_ptr<shared_sorter> sorter_{};
        std::optional<row_merge> drops_{};  ///< dropped points and their leaders
        bool is_by_number_ = false;         ///< otherwise by rank
    };

    void step_done() const;
    [[nodiscard]] joined_points& source() { return source_; }
    [[nodiscard]] const communicator& all() const { return communicator_; }
    [[nodiscard]] const point_keys& keys() const { return keys_; }
    /// Memory for sorting rows on the disk.
    [[nodiscard]] std::uint64_t sorting_memory() const { return task_.options.memory / 8; }

  private:
    struct tile {
        std::vector<record_count> points{};  ///< points that each rank wrote for it
        std::uint64_t own = 0;
        bool finished = false;
        record_count drops{};
        record_count border{};
        record_count asked{};
        record_count members{};
        longest_move move{};
    };
    struct tile_files;

    [[nodiscard]] bool has_order() const { return !task_.options.order_by.empty(); }
    /// Whether to use the rule `chain`; false if the rule `first` has the same result, since it
    /// needs less memory.
    [[nodiscard]] bool by_chain() const;
    [[nodiscard]] std::filesystem::path file(std::size_t t, const char* what) const;
    [[nodiscard]] std::size_t values() const { return keys_.agree().size(); }
    /// Number of values in a row of a tile's points, and of its border.
    [[nodiscard]] std::size_t point_width() const { return 4 + values(); }
    [[nodiscard]] std::size_t border_width() const {
        return border_numbers + (!by_chain() ? values() : 0);
    }
    [[nodiscard]] weld::number_slices slices() const {
        return weld::number_slices(survey_.cloud.points);
    }
    [[nodiscard]] std::uint64_t points_of(const tile& t) const;
    [[nodiscard]] std::filesystem::path points_file(std::size_t t, std::size_t part) const;
    /// The points of the files that a rank reads.
    [[nodiscard]] share read_by(std::size_t rank) const;
    /// The tiles of a rank, with about the same number of points as those of others; with
    /// `unfinished`, of points in unfinished tiles.
    [[nodiscard]] share tiles_of(std::size_t rank, bool unfinished = false) const;

    struct cut_sizes;
    /// Whether the needed memory depends on the survey of the points, not only on their number.
    [[nodiscard]] bool needs_survey() const;
    /// Plans the tiles.
    /// \throws io_error with the memory that would suffice, if there is not enough
    void plan();
    struct planned;
    [[nodiscard]] std::optional<planned> plan_by(bool by_places) const;
    [[nodiscard]] planned plan_for_least_memory() const;
    /// Memory of the process that suffices for a tile, and for the borders.
    struct memory_needs {
        std::uint64_t tiles = 0;
        std::uint64_t borders = 0;
    };
    [[nodiscard]] memory_needs needs_of(const cut_sizes& sizes) const;
    [[nodiscard]] memory_needs needs_of_one_tile(std::uint64_t points) const;
    [[nodiscard]] std::uint64_t needs_of_rest() const;
    /// Each throws io_error with the memory that would suffice, if there is not enough.
    void check_before_survey();
    void check_before_tile() const;
    [[noreturn]] void fail_for_memory(std::uint64_t needed, const std::string& more = {}) const;
    [[nodiscard]] point_survey::part uncrowded_sample() const;
    [[nodiscard]] const point_survey::part& places() const;
    [[nodiscard]] cut_sizes sizes_of(const tile_cuts& cuts) const;
    void set_tolerance();
    void say_plan();

    void share_cuts();
    [[nodiscard]] bool find_plan();
    void survey_tiles();
    [[nodiscard]] bool load_plan();
    /// Whether the folder has tiles to resume from, judged by file sizes.
    [[nodiscard]] bool finds_tiles();
    [[nodiscard]] bool resume_tiles();
    [[nodiscard]] bool find_tile(std::size_t t, bool check);
    void count_finished();
    /// With `check`, the checksums of its files are verified.
    [[nodiscard]] bool load_tile(std::size_t t, bool check);
    void store_plan() const;
    void store_tile(std::size_t t) const;

    void rank_points();
    void number_by_rank(row_merge& by_key, std::uint64_t rank);
    [[nodiscard]] std::filesystem::path numbers_file(std::size_t part) const;
    [[nodiscard]] std::filesystem::path ranks_file() const;
    [[nodiscard]] bool has_numbers() const;
    void give_points();
    void share_counts(std::uint64_t read, const std::vector<record_count>& given);
    void weld_tile(std::size_t t);
    void weld_held(std::size_t t, tile_files& files);
    void weld_crowded(std::size_t t, tile_files& files);
    template <class Take>
    void each_point_of(std::size_t t, const tile_files& files, const Take& take) const;
    void sort_points(std::size_t t, tile_files& files) const;
    template <class Take>
    void each_row_of(std::size_t t, const Take& take) const;

    class chain_borders;
    class run_borders;
    /// Returns the files of drops, and updates `longest`.
    [[nodiscard]] std::vector<tiles_welded::file> weld_borders_in_runs(longest_move& longest) const;
    [[nodiscard]] bool is_outer(const point3& p, const share& tiles,
                                std::vector<std::uint32_t>& halos) const;
    void distribute(tiles_welded& w, kept_points& followed) const;
    void follow(const tiles_welded& w, kept_points& kept, kept_points& followed) const;
    void sum_up(tiles_welded& w, const kept_points& kept, const kept_points& followed,
                longest_move longest) const;
    [[nodiscard]] kept_points number_kept(const kept_points& by_rank) const;
    [[nodiscard]] kept_points number_kept_by_all(const share& assigned,
                                                 const kept_points& by_rank) const;
    [[nodiscard]] share assigned_to(std::size_t rank) const;
    [[nodiscard]] std::size_t owner_of(std::uint64_t point) const {
        return communicator_.owner_of(point, survey_.cloud.points);
    }
    /// The numbers of the points with these ranks.
    [[nodiscard]] row_chain numbers_by_rank(const share& some = {}) const;
    /// Writes the border rows of a tile, and returns their number.
    static std::uint64_t put_border(weld::tile_result& result, row_writer& to);
    /// Calls `put` with each asked point and its values.
    template <class Put>
    static void put_asked(weld::tile_result& result, const Put& put) {
        const std::size_t count = result.asked.size();
        const std::size_t width = count == 0 ? 0 : result.asked_values.size() / count;
        for (std::size_t i = 0; i < count; ++i)
            put(result.asked[i], numbers(result.asked_values).subspan(i * width, width));
        result.asked.clear();
        result.asked_values.clear();
    }
    [[nodiscard]] row_reader border_rows(const std::filesystem::path& path,
                                         const record_count& count, const share& some = {}) const;
    [[nodiscard]] row_merge sorted_drops(const std::vector<tiles_welded::file>& files) const;

    [[nodiscard]] std::uint64_t most_points() const;  ///< largest number of points in a tile
    [[nodiscard]] std::size_t at_a_time() const;
    [[nodiscard]] std::uint64_t bytes_per_point() const;
    [[nodiscard]] std::size_t bytes_per_reader() const;

    cancellable_progress& pace_;
    const work_folder& folder_;
    const tile_task& task_;
    const communicator& communicator_;
    joined_points& source_;
    const point_keys& keys_;
    std::optional<unpacked_inputs> unpacked_{};
    point_survey survey_{};
    double tolerance_ = 0.0;
    std::optional<tile_cuts> cuts_{};
    memory_needs needs_{};                 ///< of the planned tiles
    bool scattered_ = false;               ///< whether the points of tiles were written
    std::vector<record_count> numbers_{};  ///< numbers of points by rank, if there is an order
    record_count ranks_{};  ///< ranks of the points that the process reads, during `scatter`
    std::vector<tile> tiles_{};
};

inline constexpr std::uint64_t records_a_check = 65536;
inline constexpr double bytes_of_border = 100.0;  ///< approximate, for each link in the border pass
inline constexpr double bytes_of_cube = 200.0;    ///< approximate, for each cube in `crowded_chain`
/// number of bytes read or written at a time
inline constexpr std::size_t piece = std::size_t{1} << 20;

}  // namespace treeform::detail::stream
