#pragma once
/// \file
/// A cloud welded in tiles on the disk, step by step; each step is found done when it has been.

#include "tools/tf-weld/kept_points.hpp"
#include "tools/tf-weld/point_survey.hpp"
#include "tools/tf-weld/record_file.hpp"
#include "tools/tf-weld/work_folder.hpp"
#include <treeform/mesh/tile_weld.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tools {

struct tile_task {
    std::filesystem::path input{};
    tf::weld_rule rule = tf::weld_rule::first;
    std::uint64_t memory = 0;           ///< bytes to work in
    std::uint64_t points_per_tile = 0;  ///< at most, about; 0: as the memory allows
    std::uint64_t stop_at = 0;          ///< for tests: the process kills itself at that step
    json identity{};                    ///< what must be the same for earlier work to be of use
};

/// What the tiles and their borders say of the whole cloud.
struct tiles_welded {
    tiles_welded(std::uint64_t points, tf::weld_rule rule, double tolerance)
        : kept(points), border(rule, tolerance) {}

    kept_points kept;
    tf::border_weld border;  ///< names the leaders
    std::uint64_t groups = 0;
    double largest_move = 0.0;
    std::vector<record_count> drops{};  ///< of each tile, and at the end those of the borders
};

class tile_steps {
  public:
    tile_steps(job& work, work_folder& folder, const tile_task& task);

    /// Reads the cloud once; or knows it from an earlier run, whose work will then be continued.
    const point_survey& look();
    /// Reads it again and gives each tile its points. \pre `look` has been called
    void scatter(double tolerance);
    /// Welds the tiles that are not finished.
    void weld_tiles();
    [[nodiscard]] tiles_welded weld_borders();

    /// Dropped points by ascending number, with the leaders that tiles and borders named; a point
    /// may come twice.
    struct id_of_drop {
        std::uint64_t operator()(const tf::tile_drop& d) const { return d.id; }
    };
    using drops = record_merge<tf::tile_drop, id_of_drop>;
    [[nodiscard]] drops all_drops(const tiles_welded& w) const;

    /// For tests: a place to be killed at.
    void step_done();

  private:
    struct tile {
        record_count points{};
        std::uint64_t own = 0;
        bool finished = false;
        record_count drops{};
        record_count border{};
        record_count members{};
        tf::longest_move move{};
    };
    struct tile_files;

    /// The rule first where it comes to the same: it holds fewer points.
    [[nodiscard]] tf::weld_rule rule() const;
    [[nodiscard]] std::filesystem::path file(std::size_t t, const char* what) const;
    [[nodiscard]] tf::tile_slabs plan() const;
    [[nodiscard]] std::optional<tf::tile_slabs> plan_by(
        const std::vector<tf::point3>& sample) const;
    [[nodiscard]] std::vector<tf::point3> uncrowded_sample() const;
    [[nodiscard]] std::vector<double> sizes_of(const tf::tile_slabs& slabs,
                                               const std::vector<tf::point3>& sample) const;
    [[nodiscard]] bool take_over(const json& plan);
    void take_over_tile(std::size_t t);
    void weld_tile(std::size_t t);
    void weld_held(std::size_t t, tile_files& files);
    void weld_crowded(std::size_t t, tile_files& files);
    template <class Take>
    void each_point_of(std::size_t t, const Take& take);
    [[nodiscard]] tf::longest_move longest_chain_move(const tf::border_weld& border) const;
    [[nodiscard]] std::size_t at_a_time() const;
    [[nodiscard]] std::uint64_t bytes_per_point() const;
    [[nodiscard]] std::size_t bytes_per_reader() const;

    job& work_;
    work_folder& folder_;
    const tile_task& task_;
    point_survey survey_{};
    double tolerance_ = 0.0;
    std::vector<tile> tiles_{};
    std::uint64_t steps_ = 0;
};

}  // namespace tools
