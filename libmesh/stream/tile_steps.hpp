#pragma once
/// \file
/// A cloud welded in tiles on the disk, step by step; each step is found done when it has been.

#include <libmesh/stream/joined_points.hpp>
#include <libmesh/stream/kept_points.hpp>
#include <libmesh/stream/pacer.hpp>
#include <libmesh/stream/point_keys.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

using weld::border_point;
using weld::border_weld;
using weld::longest_move;
using weld::tile_cuts;
using weld::tile_drop;
using weld::tile_member;
using weld::tile_point;
using weld::tile_role;

struct tile_task {
    cloud_inputs inputs{};
    weld_stream_options options{};  ///< `memory` is what is left for the points
    std::string identity{};         ///< what must be the same for earlier work to be of use
    std::uint64_t memory = 0;       ///< of the process
};

/// What the tiles and their borders say of the whole cloud.
struct tiles_welded {
    tiles_welded(std::uint64_t points, weld_rule rule, double tolerance,
                 const weld::agreement& agree)
        : kept(points), border(rule, tolerance, agree) {}

    kept_points kept;                       ///< by number in the files
    std::optional<kept_points> followed{};  ///< "dropped" in it: kept with others, if asked for
    border_weld border;                     ///< names the leaders
    std::uint64_t groups = 0;
    double max_displacement = 0.0;
    std::vector<record_count> drops{};  ///< of each tile, and at the end those of the borders
};

/// Tiles and their borders know points by their ranks: the places they have in the order that the
/// rule goes through them. Without an order to ask for, these are their numbers.
class tile_steps {
  public:
    tile_steps(pacer& pace, const work_folder& folder, const tile_task& task, joined_points& source,
               const point_keys& keys);

    /// Reads the cloud once; or knows it from an earlier run, whose work will then be continued.
    /// Then says where it will be cut.
    void look();
    [[nodiscard]] const cloud_survey& survey() const { return survey_.cloud; }
    /// Reads it again and gives each tile its points.
    void scatter();
    /// Welds the tiles that are not finished.
    void weld_tiles();
    [[nodiscard]] tiles_welded weld_borders();

    /// The kept points that points belong to; asked for one by one, from the first on.
    class leaders {
      public:
        leaders(const tile_steps& steps, const tiles_welded& welded);
        [[nodiscard]] std::uint64_t of(std::uint64_t point);

      private:
        struct rank_of_drop {
            std::uint64_t operator()(const tile_drop& d) const { return d.id; }
        };
        using drops = record_merge<tile_drop, rank_of_drop>;
        [[nodiscard]] static drops by_rank(const tile_steps& steps, const tiles_welded& w);
        void number(const tile_steps& steps, drops& ranks);

        const border_weld& border_;
        std::optional<drops> drops_{};
        std::unique_ptr<row_sorter> sorter_{};
        std::optional<row_merge> rows_{};
    };

    void step_done() const;
    [[nodiscard]] joined_points& source() { return source_; }
    [[nodiscard]] const point_keys& keys() const { return keys_; }
    /// For rows on their way to the disk and back.
    [[nodiscard]] std::uint64_t sorting_memory() const { return task_.options.memory / 8; }

  private:
    struct tile {
        record_count points{};
        std::uint64_t own = 0;
        bool finished = false;
        record_count drops{};
        record_count border{};
        record_count members{};
        longest_move move{};
    };
    struct tile_files;

    [[nodiscard]] bool has_order() const { return task_.options.order != weld_order::given; }
    /// The rule first where it comes to the same: it holds fewer points.
    [[nodiscard]] weld_rule rule() const;
    [[nodiscard]] std::filesystem::path file(std::size_t t, const char* what) const;
    [[nodiscard]] std::size_t values() const { return keys_.agree().size(); }
    /// Numbers in a row of a tile's points, and of its border.
    [[nodiscard]] std::size_t point_width() const { return 4 + values(); }
    [[nodiscard]] std::size_t border_width() const {
        return 8 + (rule() == weld_rule::first ? values() : 0);
    }
    [[nodiscard]] std::uint64_t points_of(const tile& t) const {
        return t.points.records / point_width();
    }

    struct cut_sizes;
    [[nodiscard]] tile_cuts plan();
    [[nodiscard]] std::optional<tile_cuts> plan_by(bool by_places) const;
    [[nodiscard]] tile_cuts plan_for_least_memory() const;
    [[noreturn]] void fail_for_memory(std::uint64_t needed) const;
    [[nodiscard]] point_survey::part uncrowded_sample() const;
    [[nodiscard]] const point_survey::part& places() const;
    [[nodiscard]] cut_sizes sizes_of(const tile_cuts& cuts) const;
    void set_tolerance();
    void say_plan();

    [[nodiscard]] bool take_over();
    void take_over_tile(std::size_t t);
    void store_plan() const;
    void store_tile(std::size_t t) const;

    void rank_points();
    void give_points();
    void check_points(std::uint64_t read);
    void weld_tile(std::size_t t);
    void weld_held(std::size_t t, tile_files& files);
    void weld_crowded(std::size_t t, tile_files& files);
    template <class Take>
    void each_point_of(std::size_t t, const tile_files& files, const Take& take) const;
    void sort_points(std::size_t t, tile_files& files) const;

    [[nodiscard]] record_count settle_borders(tiles_welded& w, kept_points& kept) const;
    void number_kept(const kept_points& by_rank, kept_points& kept) const;
    [[nodiscard]] longest_move longest_chain_move(const border_weld& border) const;
    [[nodiscard]] std::vector<record_count> sorted_members(const border_weld& border) const;
    [[nodiscard]] std::filesystem::path members_file(std::size_t i) const;
    [[nodiscard]] row_reader numbers_by_rank() const;

    [[nodiscard]] std::size_t at_a_time() const;
    [[nodiscard]] std::uint64_t bytes_per_point() const;
    [[nodiscard]] std::size_t bytes_per_reader() const;

    pacer& pace_;
    const work_folder& folder_;
    const tile_task& task_;
    joined_points& source_;
    const point_keys& keys_;
    point_survey survey_{};
    double tolerance_ = 0.0;
    std::optional<tile_cuts> cuts_{};      ///< until the points are in their tiles
    record_count numbers_{};               ///< of points by rank, where there is an order
    std::unique_ptr<row_sorter> ranks_{};  ///< of points by number, for as long as they are given
    std::vector<tile> tiles_{};
};

inline constexpr const char* numbers_name = "numbers";  ///< the file of points by rank
inline constexpr double bytes_of_border = 100.0;        ///< of a point in the border pass, about
inline constexpr double bytes_of_cube = 200.0;          ///< of a cube in `crowded_chain`, about
inline constexpr std::size_t piece = std::size_t{1} << 20;  ///< bytes read or written at a time

}  // namespace treeform::detail::stream
