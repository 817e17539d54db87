#pragma once
/// \file
/// Reads several point files as one cloud, from the first point to the last, or from any point on.
/// Compressed PCD files are unpacked once for all ranks.

#include <libmesh/io/las_grid_choice.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/joined_parts.hpp>
#include <libmesh/stream/work_folder.hpp>
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

/// All blocks together equal the result of `concatenate_files` for the files. One file is open at a
/// time.
class joined_points {
  public:
    /// Reads the headers. Text is read once, each rank its share of the bytes; with several ranks
    /// also points with lists. Collective: every rank must call this. With `as_las`, coordinates
    /// are rounded to the scale and offset of the first file if it is LAS, else to those of
    /// `set_las_grid`.
    ///
    /// \throws io_error, std::invalid_argument as `concatenate_files`
    joined_points(const cloud_inputs& inputs, bool as_las, const communicator& all);

    /// The joined header of all files, without points.
    [[nodiscard]] const mesh_file& header() const { return head_; }
    [[nodiscard]] std::uint64_t count() const { return count_; }

    [[nodiscard]] bool lacks_las_grid() const { return as_las_ && !head_.las; }
    void set_las_grid(las_header grid) { head_.las = std::move(grid); }
    /// Applies the requested scale and offset if the files are LAS.
    void wish_las_grid(const io::las_grid_wish& wish) {
        if (head_.las) wish.put(*head_.las);
    }

    /// Restarts at the first point of the share. A share that is not all points requires that the
    /// number of points is known.
    void rewind(const share& some = {});
    /// Reads the next points, from one file; false if none are left.
    bool read(io::point_block& block, std::size_t most);
    /// The file of the last block, and its header.
    [[nodiscard]] std::size_t file() const { return file_; }
    [[nodiscard]] const mesh_file& file_header() const { return reader_->header(); }
    /// Whether float32 holds the coordinates of the last block exactly, as they were in the file.
    [[nodiscard]] bool is_single(const io::point_block& block) const {
        return is_rounded() ? single_ : fits_float32(block.points);
    }

    [[nodiscard]] std::size_t files() const { return formats_.size(); }
    [[nodiscard]] const std::string& format(std::size_t file) const { return formats_[file]; }
    /// From now on, reads points of compressed files from these unpacked files; paths for other
    /// files are empty.
    void read_unpacked(std::vector<std::filesystem::path> files) { unpacked_ = std::move(files); }
    /// The index of the records of a file, if they were surveyed; else null.
    [[nodiscard]] const io::record_index* known(std::size_t file) const {
        return known_[file] ? &*known_[file] : nullptr;
    }

    /// The warnings of files that were read to their end.
    [[nodiscard]] const std::vector<io_warning>& warnings() const { return warnings_; }
    /// The largest change of a coordinate by `as_las`.
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
    std::vector<std::uint64_t> counts_{};  ///< number of points of each file
    std::vector<std::optional<io::record_index>>
        known_{};  ///< index of each file whose records were surveyed
    std::vector<std::filesystem::path> unpacked_{};
    std::vector<io_warning> of_join_{};
    std::vector<io_warning> warnings_{};
    std::optional<io::point_blocks> reader_{};
    std::size_t file_ = 0;
    std::uint64_t left_ = 0;  ///< points of the share not read yet
    bool ended_ = false;
    bool fits_ = true;  ///< whether the file has the columns of the joined header
    bool single_ = true;
    double moved_ = 0.0;
};

/// Unpacks the compressed data of `pcd` to an empty file that rank 0 created, and returns the
/// number of unpacked bytes. Decompression is sequential, so ranks unpack their shares (of bytes
/// read and written) in turn, and send their position to the next rank. Collective: every rank must
/// call this.
///
/// \throws io_error, the same on all ranks if the data is damaged; cancelled
std::uint64_t unpack_in_turn(const std::filesystem::path& pcd, const std::filesystem::path& to,
                             const communicator& all, cancellable_progress& pace);

/// Unpacked inputs in the folder, from which points are read until the end.
class unpacked_inputs {
  public:
    /// Collective: every rank must call this. \throws as `unpack_in_turn`
    unpacked_inputs(const work_folder& folder, const communicator& all, const cloud_inputs& inputs,
                    joined_points& source, cancellable_progress& pace);

    /// Their size in the folder, in bytes.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  private:
    passing_files files_;
    std::uint64_t bytes_ = 0;
};

}  // namespace treeform::detail::stream
