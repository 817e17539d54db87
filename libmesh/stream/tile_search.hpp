#pragma once
/// \file
/// The faces of a file in tiles on the disk, and the pairs of each tile. Steps are idempotent; a
/// restart skips finished ones.

#include <libmesh/io/face_rows.hpp>
#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/space_cells.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

/// A face in a tile.
template <class Real>
struct tile_face {
    std::uint32_t triangle = 0;  ///< of the file
    std::uint32_t stored = 0;
    /// Numbers of points; the records of doubles end with a zero, so that no byte is unset.
    std::array<std::uint32_t, sizeof(Real) == 8 ? 4 : 3> corners{};
    std::array<Real, 9> at{};
};
static_assert(sizeof(tile_face<float>) == 56 && sizeof(tile_face<double>) == 96);

/// Numbers of triangles of the file.
struct tile_pair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t kind = 0;
    std::uint32_t unused = 0;
};

/// What was found in a tile: pairs, the faces in them, and the counters.
struct tile_found {
    record_count pairs{};
    record_count faces{};
    intersection_result counted{};  ///< without pairs
};

/// For what is stored, and what ranks exchange.
void store_box(const std::optional<box3>& box, state_writer& state);
[[nodiscard]] std::optional<box3> load_box(state_reader& state);
void store_search(const stream_search_result& s, state_writer& state);
[[nodiscard]] stream_search_result load_search(state_reader& state);

class tile_search {
  public:
    tile_search(cancellable_progress& pace, const work_folder& folder, const communicator& of,
                std::filesystem::path input, stream_search_options options);

    /// Gives each tile its faces, or knows from an earlier run that they have them. Of several
    /// ranks, each gives those of its part of the file.
    /// \throws io_error, cancelled
    void scatter();
    /// Whether `scatter` has been done, here or elsewhere.
    [[nodiscard]] bool is_known() { return tiles() > 0 || take_over(); }
    /// Whether the folder has tiles, be it of another input or of other options.
    [[nodiscard]] bool has_plan() const;
    [[nodiscard]] std::size_t tiles() const { return faces_.size(); }
    [[nodiscard]] std::vector<std::size_t> unfinished() const;
    /// Searches it, unless it is finished. What two processes do at the same time is the same.
    /// `part` and `of` are for the progress. \throws std::out_of_range, io_error, cancelled
    void search(std::size_t tile, std::size_t part, std::size_t of);
    /// The faces of a finished tile are needed no more.
    void drop_faces(std::size_t tile) const;
    /// Puts together what was found. \throws io_error naming the tiles that are not finished
    [[nodiscard]] stream_search_result finish();

  private:
    [[nodiscard]] std::filesystem::path file(std::size_t tile, const char* what) const;
    [[nodiscard]] std::filesystem::path faces_file(std::size_t tile, std::size_t part) const;

    [[nodiscard]] std::string identity() const;
    void store_plan() const;
    [[nodiscard]] bool take_over();
    /// What is stored of a tile; none where it is not finished. With `check`, of what it names,
    /// each byte is looked at.
    [[nodiscard]] std::optional<tile_found> load(std::size_t tile, bool check) const;
    void store(std::size_t tile, const tile_found& found) const;

    [[nodiscard]] std::size_t tile_count(std::uint64_t faces) const;
    /// Returns false where faces could not be read; where all have been read in turn, all ranks
    /// throw then.
    [[nodiscard]] bool give_tiles(bool in_turn);
    [[nodiscard]] bool share_rows(const io::face_rows& rows, bool in_turn,
                                  const io::record_index* known) const;
    template <class Real>
    void give_all(io::face_rows& rows);
    void share_head(io::face_rows& rows) const;
    [[nodiscard]] std::optional<std::string> share_counts(
        const std::optional<std::string>& failure);
    void forget_tiles();
    void check_memory() const;
    void look_at(const std::vector<io::placed_triangle>& block,
                 std::vector<std::uint32_t>& searched);
    template <class Real>
    [[nodiscard]] std::vector<tile_face<Real>> faces_of(std::size_t tile) const;
    template <class Real>
    void search_as(std::size_t tile);

    cancellable_progress& pace_;
    const work_folder& folder_;
    const communicator& all_;
    std::filesystem::path input_;
    stream_search_options options_;
    std::uint64_t memory_;  ///< what is left for faces
    stream_search_result survey_{};
    bool bounds_known_ = false;
    bool others_read_ = false;  ///< what is in the folder
    vertex_identity vertices_{};
    std::optional<space_cells> cells_{};
    std::vector<std::vector<record_count>> faces_{};  ///< of each tile, that each rank gave it
    std::vector<std::uint64_t> firsts_{};             ///< triangle of each rank
};

}  // namespace treeform::detail::stream
