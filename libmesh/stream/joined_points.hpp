#pragma once
/// \file
/// Clouds in any number of files, read as one from the first point to the last, or from any on.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/io/point_blocks.hpp>
#include <libmesh/stream/communicator.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

/// All blocks together are what `join` makes of the files. One file is open at a time.
class joined_points {
  public:
    /// Reads what precedes the points of each file, and text once, of which each of `all` reads its
    /// share of the bytes; of several also points with lists. Collective: every rank must call
    /// this. With `as_las`, coordinates become those that a LAS file with the first one's scale and
    /// offset holds, or with those that are set.
    ///
    /// \throws io_error, std::invalid_argument as `join`
    joined_points(const cloud_inputs& inputs, bool as_las, const communicator& all);

    /// Of all files together, without points.
    [[nodiscard]] const mesh_file& header() const { return head_; }
    [[nodiscard]] std::uint64_t count() const { return count_; }

    [[nodiscard]] bool lacks_las_grid() const { return as_las_ && !head_.las; }
    void set_las_grid(las_header grid) { head_.las = std::move(grid); }
    /// Of files that are LAS.
    void wish_las_grid(const io::las_grid_wish& wish) {
        if (head_.las) wish.put(*head_.las);
    }

    /// Starts again, with the first point of the share; of one that is not all, where the number of
    /// points is known.
    void rewind(const share& some = {});
    /// The next points, of one file; false when none are left.
    bool read(io::point_block& block, std::size_t most);
    /// The file that the last block came from, and its header.
    [[nodiscard]] std::size_t file() const { return file_; }
    [[nodiscard]] const mesh_file& file_header() const { return reader_->header(); }
    /// Whether float32 held the last block as it was in the file.
    [[nodiscard]] bool is_single(const io::point_block& block) const {
        return is_rounded() ? single_ : fits_single(block.points);
    }

    [[nodiscard]] std::size_t files() const { return formats_.size(); }
    [[nodiscard]] const std::string& format(std::size_t file) const { return formats_[file]; }
    /// Points of compressed files are from now on read from these; of others they are empty.
    void read_unpacked(std::vector<std::filesystem::path> files) { unpacked_ = std::move(files); }
    /// What is known of its records where these have been looked at, or null.
    [[nodiscard]] const io::record_index* known(std::size_t file) const {
        return known_[file] ? &*known_[file] : nullptr;
    }

    /// Of files that were read to their ends.
    [[nodiscard]] const std::vector<io_warning>& warnings() const { return warnings_; }
    /// The furthest that LAS has moved a coordinate.
    [[nodiscard]] double moved() const { return moved_; }

  private:
    [[nodiscard]] io::reading how() const { return {inputs_.format, {.columns = inputs_.columns}}; }
    void open(std::size_t file, std::uint64_t first = 0);
    [[nodiscard]] io::point_block read_first(std::uint64_t count);
    [[nodiscard]] bool read_some(io::point_block& block, std::size_t most);
    void take_warnings();
    void fit(io::point_block& block);
    [[nodiscard]] bool is_rounded() const { return as_las_ && head_.las; }

    const cloud_inputs& inputs_;
    bool as_las_;
    mesh_file head_{};
    std::uint64_t count_ = 0;
    std::vector<std::string> formats_{};
    std::vector<std::uint64_t> counts_{};  ///< of files
    std::vector<std::optional<io::record_index>>
        known_{};  ///< of files whose records were looked at
    std::vector<std::filesystem::path> unpacked_{};
    std::vector<io_warning> of_join_{};
    std::vector<io_warning> warnings_{};
    std::optional<io::point_blocks> reader_{};
    std::size_t file_ = 0;
    std::uint64_t left_ = 0;  ///< of the share
    bool ended_ = false;
    bool fits_ = true;  ///< the file has the columns of all
    bool single_ = true;
    double moved_ = 0.0;
};

}  // namespace treeform::detail::stream
