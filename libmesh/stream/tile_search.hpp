#pragma once
/// \file
/// The faces of a file in tiles on the disk, and the pairs of each tile. Steps are idempotent; a
/// restart skips finished ones.

#include <libmesh/io/point_rows.hpp>
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
    std::uint32_t triangle = 0;  ///< its number in the file
    std::uint32_t stored = 0;
    /// Point numbers; for doubles padded with a zero, so that all bytes are set.
    std::array<std::uint32_t, sizeof(Real) == 8 ? 4 : 3> corners{};
    std::array<Real, 9> at{};
};
static_assert(sizeof(tile_face<float>) == 56 && sizeof(tile_face<double>) == 96);

/// A pair of triangle numbers in the file.
struct tile_pair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t kind = 0;
    std::uint32_t unused = 0;
};

/// The result of a tile: pairs, the faces in them, and counters.
struct tile_found {
    record_count pairs{};
    record_count faces{};
    face_pair_result counted{};  ///< without pairs
};

/// Serialization, for storing and for exchange between ranks.
void store_box(const std::optional<box3>& box, state_writer& state);
[[nodiscard]] std::optional<box3> load_box(state_reader& state);
void store_search(const file_search_result& s, state_writer& state);
[[nodiscard]] file_search_result load_search(state_reader& state);

class tile_search {
  public:
    tile_search(cancellable_progress& pace, const work_folder& folder, const communicator& of,
                std::filesystem::path input, file_search_options options);

    /// Writes the faces of each tile, unless an earlier run did. With several ranks, each writes
    /// those of its part of the file.
    /// \throws io_error, cancelled
    void scatter();
    /// Whether `scatter` was completed, by this or another process.
    [[nodiscard]] bool has_tiles() { return tiles() > 0 || load_plan(); }
    /// Whether the folder has tiles, even of another input or other options.
    [[nodiscard]] bool has_plan() const;
    [[nodiscard]] std::size_t tiles() const { return faces_.size(); }
    [[nodiscard]] std::vector<std::size_t> unfinished() const;
    /// Searches a tile, unless it is finished. Two processes that search the same tile write the
    /// same bytes. `part` and `of` are for the progress. \throws std::out_of_range, io_error,
    /// cancelled
    void search(std::size_t tile, std::size_t part, std::size_t of);
    /// Removes the faces of a finished tile.
    void drop_faces(std::size_t tile) const;
    /// Combines the results of all tiles. \throws io_error naming the tiles that are not finished
    [[nodiscard]] file_search_result finish();

  private:
    [[nodiscard]] std::filesystem::path file(std::size_t tile, const char* what) const;
    [[nodiscard]] std::filesystem::path faces_file(std::size_t tile, std::size_t part) const;

    [[nodiscard]] std::string identity() const;
    void store_plan() const;
    [[nodiscard]] bool load_plan();
    /// The stored result of a tile; none if it is not finished. With `check`, the checksums of its
    /// files are verified.
    [[nodiscard]] std::optional<tile_found> load(std::size_t tile, bool check) const;
    void store(std::size_t tile, const tile_found& found) const;

    [[nodiscard]] std::size_t tile_count(std::uint64_t faces) const;
    /// Returns false if faces could not be read. With `in_turn`, all ranks throw instead.
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
    file_search_options options_;
    std::uint64_t memory_;  ///< memory available for faces
    file_search_result survey_{};
    bool bounds_known_ = false;
    bool others_read_ = false;  ///< whether other ranks may be reading files of the folder
    vertex_identity vertices_{};
    std::optional<space_cells> cells_{};
    /// [tiles][ranks] faces that each rank wrote for each tile
    std::vector<std::vector<record_count>> faces_{};
    std::vector<std::uint64_t> firsts_{};  ///< first triangle of each rank
};

}  // namespace treeform::detail::stream
