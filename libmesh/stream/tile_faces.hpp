#pragma once
/// \file
/// Faces, and other rows behind the points, of a mesh that is welded in tiles.

#include <libmesh/io/point_blocks.hpp>
#include <libmesh/stream/edge_files.hpp>
#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/paged_file.hpp>
#include <libmesh/stream/rows_in_turn.hpp>
#include <libmesh/stream/tile_steps.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::stream {

inline constexpr std::size_t rows_a_block = std::size_t{1} << 15;

/// How many are read at once where so many are left.
[[nodiscard]] inline std::size_t rows_of_next(std::uint64_t left, std::size_t most = rows_a_block) {
    return static_cast<std::size_t>(std::min<std::uint64_t>(left, most));
}

/// Corners of the face that has most.
[[nodiscard]] std::size_t longest_face(const io::row_block& block);

/// Whether a file has rows behind its points.
[[nodiscard]] bool has_rows_behind(const mesh_file& header);

/// Each rank has a share of the rows: a part of the file of about as many bytes as those of
/// others. Where that is known without reading them (`point_blocks::row_parts`, and in text), each
/// looks at its own; else, as where faces have any number of corners, each in turn looks at what
/// begins in its share of the bytes, and reports where that ends.
class tile_faces {
  public:
    tile_faces(cancellable_progress& pace, const work_folder& folder, const tile_task& task,
               tile_steps& steps)
        : pace_(pace),
          folder_(folder),
          task_(task),
          steps_(steps),
          is_soup_(!steps.source().header().indexed) {}
    ~tile_faces();
    tile_faces(const tile_faces&) = delete;
    tile_faces& operator=(const tile_faces&) = delete;

    /// Reads all rows once. Counts faces in `survey`, which gets what is to be said of the end of
    /// the file. Collective: every rank must call this and `weld`.
    /// \throws io_error for what is not as it should be, the first of it in the file; cancelled
    void take_survey(cloud_survey& survey);
    /// Reads the points and the rows once, each rank its share. `rows` as for `give_back`.
    /// \throws io_error, cancelled
    void weld(tiles_welded& welded, kept_rows* rows, weld_stream_result& made);
    /// How many rows `give` will write. With `all`, faces stay as they are.
    void describe(mesh_file& head, bool all) const;
    [[nodiscard]] std::size_t most_corners(bool all) const {
        return all ? most_corners_ : most_kept_corners_;
    }
    /// Reads the rows once more: all of them, on one rank; or its share, where all call this.
    /// \pre `weld` was called
    void give(point_writer& to, bool all, bool whole);

  private:
    using corners_of_block = std::array<std::size_t, 3>;

    [[nodiscard]] file_of_rows file() const;
    [[nodiscard]] io::point_blocks open() const;
    [[nodiscard]] io_error changed() const;
    /// Calls `take` with the rows of the share, or of the whole file.
    template <class Take>
    void each_block(bool whole, const Take& take);
    [[nodiscard]] bool is_last() const { return steps_.all().rank() + 1 == steps_.all().size(); }
    void start_survey(cloud_survey& survey);
    [[nodiscard]] bool survey_part(cloud_survey& survey);
    void survey_whole(cloud_survey& survey);
    void survey_in_turn(cloud_survey& survey);
    void survey_rows(const io::row_block& block, cloud_survey& survey);
    void end_survey(const io::point_blocks& reader, cloud_survey& survey) const;
    [[nodiscard]] bool share_survey(cloud_survey& survey, bool seen);
    void number_points(tiles_welded& welded, kept_rows* rows, bool has_moves);
    void open_numbers();
    void carry_all();
    void share_counts();
    void look_at_corners(const io::point_block& block, std::uint64_t point);
    void drop_blank(element& faces) const;
    void carry(const io::row_block& from, io::row_block& to);
    void look_up(std::span<const std::uint32_t> corners);
    void carry_face(const io::row_block& from, std::uint32_t row, io::row_block& to);
    void renumber(io::row_block& block);
    [[nodiscard]] bool is_kept(const face& before, const face& after, const corners_of_block& at);
    [[nodiscard]] bool is_flipped(const corners_of_block& at) const;
    [[nodiscard]] std::uint32_t number_of(std::uint64_t point) {
        return static_cast<std::uint32_t>(numbers_->at(point));
    }

    cancellable_progress& pace_;
    const work_folder& folder_;
    const tile_task& task_;
    tile_steps& steps_;
    std::vector<io::row_place>
        parts_{};  ///< of several ranks: where that of each begins, and the last one ends
    std::size_t rows_at_once_ = rows_a_block;
    std::uint64_t left_out_ = 0;  ///< faces of fewer than three corners
    std::size_t most_corners_ = 0;
    std::size_t most_kept_corners_ = 0;
    weld_stream_result made_{};                           ///< what is counted of it
    std::uint64_t kept_places_ = 0;                       ///< records of `after_`
    bool counts_now_ = false;                             ///< in the pass that counts
    bool is_blank_ = false;                               ///< a soup that has nothing but corners
    bool is_soup_;                                        ///< faces have corners of their own
    std::vector<point3> corners_of_soup_{};               ///< of the face that begins
    std::optional<paged_file<std::uint64_t>> numbers_{};  ///< new ones, by points
    std::optional<paged_file<point3>> before_{};          ///< places, by points
    std::optional<paged_file<point3>> after_{};           ///< places, by new numbers
    std::optional<edge_files<numbered_edge>> edges_before_{};
    std::optional<edge_files<placed_edge>> edges_of_soup_{};
    std::optional<edge_files<numbered_edge>> edges_after_{};
    std::vector<std::uint32_t> rows_{};     ///< that faces of a block come from
    std::vector<std::uint32_t> corners_{};  ///< new ones of a block
    std::vector<point3> places_before_{};   ///< of these
    std::vector<point3> places_after_{};
};

}  // namespace treeform::detail::stream
