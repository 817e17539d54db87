#pragma once
/// \file
/// Writes points to a file, of which each rank may write a part.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/row_file.hpp>
#include <libmesh/stream/tile_faces.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

/// Moves points at the begin of a part of a file to an earlier part, so that all parts have a
/// multiple of some number of points.
class leading_points {
  public:
    /// The process has `mine` points, which follow those of lower ranks; parts must have a multiple
    /// of `together` points. Collective: every rank must call this. \pre the points have no lists
    leading_points(const work_folder& folder, const communicator& all, const std::string& name,
                   const mesh_file& header, std::uint64_t mine, std::uint64_t together);

    /// Removes points that belong to an earlier part from the front of the next block.
    void take_off(io::point_block& block);
    /// Calls `write` with the points of later ranks that complete this part. Collective: every rank
    /// must call this.
    void give(const std::function<void(const io::point_block&)>& write);

  private:
    const mesh_file& header_;
    packed_points packed_;
    all_to_all exchanged_;
    std::uint64_t left_ = 0;  ///< points left that belong to an earlier part
    std::size_t to_ = 0;      ///< the rank of that part
    std::vector<std::uint64_t> row_{};
};

using output_path = std::pair<std::filesystem::path, write_options>;

/// Writes rows of blocks to a point file.
class points_out {
  public:
    /// `all`: each rank writes a part. Null: this process writes the whole file.
    points_out(const output_path& to, const mesh_file& header, std::uint64_t count,
               const communicator* all, const std::filesystem::path& part,
               std::size_t most_corners = 0);

    [[nodiscard]] static write_options options_of(const output_path& to);

    void write(const io::point_block& block, const std::vector<std::uint32_t>& rows);
    void write(const io::point_block& block);
    /// Begins the part of the process, which has `mine` points. Collective: every rank must call
    /// this.
    void start_part(const work_folder& folder, const mesh_file& header, const std::string& name,
                    std::uint64_t mine);
    void write(tile_faces& faces, bool all);
    write_result commit();

  private:
    void write_to_file(const io::point_block& block) {
        writer_.write(block.points, block.properties);
    }
    void share_values(const std::filesystem::path& file, std::uint64_t mine);
    [[nodiscard]] std::string head_of_part(const detail::io::written_part& part) const;

    std::filesystem::path target_;
    std::filesystem::path path_;
    const communicator* all_;
    point_writer writer_;
    std::optional<leading_points> leading_{};
    std::optional<passing_files> values_{};  ///< values of all parts, if parts share them
    io::point_block some_{};
};

}  // namespace treeform::detail::stream
