#pragma once
/// \file
/// Point files a block at a time, for clouds that are larger than memory.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace treeform {

/// A run of points with their properties, as `mesh_file` holds those of a whole file.
struct point_block {
    std::vector<point3> points{};
    element properties{.name = "vertex"};  ///< a row a point
};

/// Reads PLY without faces, PCD, XYZ and CSV from the front to the back. What comes out, block
/// behind block, is what `read` gives for the whole file.
class TREEFORM_API point_reader {
  public:
    /// Reads the header. `path` and `format` as for `read`. What is no file that can be mapped
    /// (standard input, a pipe) goes to a file without a name in /var/tmp first, and so do the
    /// unpacked points of a compressed PCD.
    ///
    /// \throws io_error for a format that is not of points, for a file with faces or other elements
    ///         that have rows, and as `read`
    explicit point_reader(const std::filesystem::path& path, std::string_view format = {});
    ~point_reader();
    point_reader(point_reader&&) noexcept;
    point_reader& operator=(point_reader&&) noexcept;

    /// Format, precision, comments and columns (without rows) of the file; no points. `stored_as`
    /// is what the types in the file can hold, `float64` for text. Text without a header (XYZ, CSV)
    /// is gone through once for its number of lines and for whether they are alike. What is to be
    /// said about the end of the file is among the warnings when `read` has returned false.
    [[nodiscard]] const mesh_file& header() const;
    /// Points in the file, where its header says so.
    [[nodiscard]] std::optional<std::uint64_t> count() const;
    /// Replaces the content of `block` by the next points, at most `most`; false, and an empty
    /// block, when there are none left.
    ///
    /// \throws io_error as `read`
    bool read(point_block& block, std::size_t most);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Writes what `write` would write for all blocks together. A compressed PCD, which is what
/// becomes of one that was, is put together in a file without a name in /var/tmp.
class TREEFORM_API point_writer {
  public:
    /// `header` as `point_reader::header` gives it, with columns added or removed; `count` points
    /// will come. Coordinates are written with the types of their columns in "vertex", in binary as
    /// doubles where all of these are at most float32 and `stored_as` says float64.
    ///
    /// \throws io_error as `write`; also for a format other than ply, pcd, xyz and csv
    point_writer(const std::filesystem::path& path, const mesh_file& header, std::uint64_t count,
                 const write_options& options = {});
    ~point_writer();
    point_writer(point_writer&&) noexcept;
    point_writer& operator=(point_writer&&) noexcept;

    /// \throws io_error when the file cannot be written, std::invalid_argument for columns that are
    ///         not those of the header, more points than were announced, or a coordinate that the
    ///         header's types do not hold and no `options.precision` says to round
    void write(const point_block& block);
    /// Puts the file into place; without it nothing stays.
    /// \throws io_error, also when fewer points came than were announced
    write_result commit();

  private:
    struct state;
    std::unique_ptr<state> state_;
};

}  // namespace treeform
