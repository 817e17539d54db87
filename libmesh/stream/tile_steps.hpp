#pragma once
/// \file
/// A cloud welded in tiles on the disk, step by step; each step is found done when it has been.

#include <libmesh/stream/kept_points.hpp>
#include <libmesh/stream/pacer.hpp>
#include <libmesh/stream/point_survey.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

using weld::border_point;
using weld::border_weld;
using weld::longest_move;
using weld::tile_drop;
using weld::tile_member;
using weld::tile_point;
using weld::tile_role;
using weld::tile_slabs;

struct tile_task {
    std::filesystem::path input{};
    weld_stream_options options{};  ///< `memory` is what is left for the points
    std::string identity{};         ///< what must be the same for earlier work to be of use
};

/// What the tiles and their borders say of the whole cloud.
struct tiles_welded {
    tiles_welded(std::uint64_t points, weld_rule rule, double tolerance)
        : kept(points), border(rule, tolerance) {}

    kept_points kept;
    border_weld border;  ///< names the leaders
    std::uint64_t groups = 0;
    double max_displacement = 0.0;
    std::vector<record_count> drops{};  ///< of each tile, and at the end those of the borders
};

class tile_steps {
  public:
    tile_steps(pacer& pace, const work_folder& folder, const tile_task& task);

    /// Reads the cloud once; or knows it from an earlier run, whose work will then be continued.
    /// Then says where it will be cut.
    void look();
    [[nodiscard]] const cloud_survey& survey() const { return survey_.cloud; }
    /// Reads it again and gives each tile its points.
    void scatter();
    /// Welds the tiles that are not finished.
    void weld_tiles();
    [[nodiscard]] tiles_welded weld_borders();

    /// Dropped points by ascending number, with the leaders that tiles and borders named; a point
    /// may come twice.
    struct id_of_drop {
        std::uint64_t operator()(const tile_drop& d) const { return d.id; }
    };
    using drops = record_merge<tile_drop, id_of_drop>;
    [[nodiscard]] drops all_drops(const tiles_welded& w) const;

    void step_done() const;

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

    /// The rule first where it comes to the same: it holds fewer points.
    [[nodiscard]] weld_rule rule() const;
    [[nodiscard]] std::filesystem::path file(std::size_t t, const char* what) const;

    [[nodiscard]] tile_slabs plan() const;
    [[nodiscard]] std::optional<tile_slabs> plan_by(const std::vector<point3>& sample) const;
    [[nodiscard]] std::vector<point3> uncrowded_sample() const;
    [[nodiscard]] std::vector<double> sizes_of(const tile_slabs& slabs,
                                               const std::vector<point3>& sample) const;
    void set_tolerance();
    void say_plan();

    [[nodiscard]] bool take_over();
    void take_over_tile(std::size_t t);
    void store_plan() const;
    void store_tile(std::size_t t) const;

    void give_points();
    void weld_tile(std::size_t t);
    void weld_held(std::size_t t, tile_files& files);
    void weld_crowded(std::size_t t, tile_files& files);
    template <class Take>
    void each_point_of(std::size_t t, const Take& take);

    [[nodiscard]] record_count settle_borders(tiles_welded& w) const;
    [[nodiscard]] longest_move longest_chain_move(const border_weld& border) const;
    [[nodiscard]] std::vector<record_count> sorted_members(const border_weld& border) const;
    [[nodiscard]] std::filesystem::path members_file(std::size_t i) const;

    [[nodiscard]] std::size_t at_a_time() const;
    [[nodiscard]] std::uint64_t bytes_per_point() const;
    [[nodiscard]] std::size_t bytes_per_reader() const;

    pacer& pace_;
    const work_folder& folder_;
    const tile_task& task_;
    point_survey survey_{};
    double tolerance_ = 0.0;
    std::optional<tile_slabs> slabs_{};  ///< until the points are in their tiles
    std::vector<tile> tiles_{};
};

inline constexpr std::size_t piece = std::size_t{1} << 20;  ///< bytes read or written at a time

}  // namespace treeform::detail::stream
