#pragma once
/// \file
/// Faces, and other rows after the points, of a mesh that is welded in tiles.

#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/edge_files.hpp>
#include <libmesh/stream/kept_rows.hpp>
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

/// The number of rows to read next if `left` are left.
[[nodiscard]] inline std::size_t rows_of_next(std::uint64_t left, std::size_t most = rows_a_block) {
    return static_cast<std::size_t>(std::min<std::uint64_t>(left, most));
}

/// The largest number of corners of a face.
[[nodiscard]] std::size_t longest_face(const row_block& block);

/// Whether a file has rows after its points.
[[nodiscard]] bool has_rows_behind(const mesh_file& header);

/// Each rank has a share of the rows: parts of the file of about equal size in bytes. If the parts
/// are known without reading the rows (`point_blocks::row_parts`, and in text), each rank surveys
/// its own; otherwise, as for faces with any number of corners, ranks survey in turn the rows that
/// begin in their share of the bytes, and report where these end.
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

    /// Reads all rows once. Counts faces in `survey`, and adds warnings about the end of the file.
    /// Collective: every rank must call this and `weld`.
    /// \throws io_error for the first error in the file; cancelled
    void take_survey(cloud_survey& survey);
    /// Reads the points and the rows once, each rank its share. `rows` as for `write_outputs`.
    /// \throws io_error, cancelled
    void weld(tiles_welded& welded, kept_rows* rows, weld_stream_result& made);
    /// Sets the number of rows in `head` that `give` will write. With `all`, all faces are kept.
    void describe(mesh_file& head, bool all) const;
    [[nodiscard]] std::size_t most_corners(bool all) const {
        return all ? most_corners_ : most_kept_corners_;
    }
    /// Reads the rows once more, and writes them: all rows (`whole`), on one rank, or the share of
    /// each rank.
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
    void survey_rows(const row_block& block, cloud_survey& survey);
    void end_survey(const io::point_blocks& reader, cloud_survey& survey) const;
    [[nodiscard]] bool share_survey(cloud_survey& survey, bool seen);
    void number_points(tiles_welded& welded, kept_rows* rows, bool has_moves);
    void open_numbers();
    void carry_all();
    void share_counts();
    void look_at_corners(const io::point_block& block, std::uint64_t point);
    void drop_blank(element& faces) const;
    void carry(const row_block& from, row_block& to);
    void look_up(std::span<const std::uint32_t> corners);
    void carry_face(const row_block& from, std::uint32_t row, row_block& to);
    void renumber(row_block& block);
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
        parts_{};  ///< with several ranks: the begin of the rows of each, and the end of the last
    std::size_t rows_at_once_ = rows_a_block;
    std::uint64_t left_out_ = 0;  ///< number of faces with fewer than three corners
    std::size_t most_corners_ = 0;
    std::size_t most_kept_corners_ = 0;
    weld_stream_result made_{};      ///< only counts
    std::uint64_t kept_places_ = 0;  ///< number of records of `after_`
    bool counts_now_ = false;        ///< during the pass that counts
    bool is_blank_ = false;          ///< whether the faces of a soup have no data except corners
    bool is_soup_;                   ///< whether faces do not share points
    std::vector<point3> corners_of_soup_{};               ///< corners of the current face so far
    std::optional<paged_file<std::uint64_t>> numbers_{};  ///< new number of each point
    std::optional<paged_file<point3>> before_{};          ///< position of each point
    std::optional<paged_file<point3>> after_{};           ///< position of each new number
    std::optional<edge_files<numbered_edge>> edges_before_{};
    std::optional<edge_files<placed_edge>> edges_of_soup_{};
    std::optional<edge_files<numbered_edge>> edges_after_{};
    std::vector<std::uint32_t> rows_{};     ///< source row of each face of a block
    std::vector<std::uint32_t> corners_{};  ///< new corners of a block
    std::vector<point3> places_before_{};   ///< positions of these
    std::vector<point3> places_after_{};
};

/// Removes unfinished outputs of a process that was killed while it wrote them.
void remove_leftovers(const work_folder& folder);

/// The last pass over the input: writes the kept points and the other requested outputs. `rows` are
/// the kept rows of groups; null if their first points are kept. `faces` are those of a welded
/// mesh; null for a cloud. Records in `made` what was written.
///
/// \throws io_error, also if the input changed meanwhile; cancelled; std::logic_error unless input
///         points = kept + removed points
void write_outputs(cancellable_progress& pace, const tile_task& task,
                   const weld_stream_outputs& outputs, tile_steps& steps, tiles_welded& welded,
                   kept_rows* rows, tile_faces* faces, const work_folder& folder,
                   weld_stream_result& made);

}  // namespace treeform::detail::stream
