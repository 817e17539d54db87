#pragma once
/// \file
/// Reads and writes point files in blocks, for clouds that are larger than memory; and the faces
/// and other rows that follow the points in a PLY or STL.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform {

/// Consecutive rows of an element that follows the points, such as faces.
struct row_block {
    element rows{};  ///< values, under the element's name
    /// for faces: point numbers of the corners, face after face
    std::vector<std::uint32_t> corners{};
    /// for faces: [rows + 1] first corner of each in `corners`; else empty
    std::vector<std::uint64_t> first_corner{};
    /// Number of faces with fewer than three corners that were skipped in this block; the header
    /// counts them.
    std::uint64_t left_out = 0;
};

/// Reads PLY without faces, PCD, LAS, LAZ, XYZ and CSV from the first point to the last. All blocks
/// together equal the result of `read` for the whole file.
class TREEFORM_API point_reader {
  public:
    /// Opens the file and reads the header. `path` and `format` are as for `read`. Input that
    /// cannot be mapped into memory (standard input, a pipe) is first copied to an unnamed file in
    /// /var/tmp. The points of a compressed PCD are unpacked to such a file before the first block
    /// is read, so that damage is found then. Reading starts at point `first`, which must not
    /// exceed the number of points. In binary PLY without lists, binary PCD and LAS, earlier points
    /// are skipped without reading them; in LAZ, whole chunks of them are.
    ///
    /// With `with_rows`, a PLY may have faces and other elements after its points, and a binary STL
    /// is read as the corners of its facets, followed by the facets. The header has the number of
    /// rows of each element; they can be read after the points. The facets of an STL always have
    /// the column "stl_attribute", even if all values are zero.
    ///
    /// \throws io_error of `kind::blocks` for a format that is not supported, or a file with rows
    ///         of faces or other elements; with `with_rows`, for rows before the points, triangle
    ///         strips, and faces with texture coordinates of corners. io_error as `read`
    explicit point_reader(const std::filesystem::path& path, std::string_view format = {},
                          std::uint64_t first = 0, bool with_rows = false,
                          const read_options& options = {});
    ~point_reader();
    point_reader(point_reader&&) noexcept;
    point_reader& operator=(point_reader&&) noexcept;

    /// The file without its points: format, precision, comments, and columns without values.
    /// `stored_as` follows the types in the file; it is `float64` for text. Text without a header
    /// (XYZ, CSV) is read once to count and check its lines. Warnings about the end of the file are
    /// added before `read` returns false.
    [[nodiscard]] const mesh_file& header() const;
    /// Number of points in the file.
    [[nodiscard]] std::uint64_t count() const;
    /// Reads the next points, at most `most`: replaces the content of `points` by their
    /// coordinates, and of `properties` by one row for each. Returns false, with both empty, if no
    /// point is left.
    ///
    /// \throws io_error as `read`
    bool read(std::vector<point3>& points, element& properties, std::size_t most);
    /// With `with_rows`: reads the next rows of one element, at most `most`, in the order of the
    /// file. Points that have not been read are skipped. Returns false if no row is left.
    ///
    /// \throws io_error as `read`
    bool read(row_block& block, std::size_t most);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

namespace detail::io {

/// Storage shared by the writers of all parts of a file, as large as the values of all points. A
/// writer puts the values of its points there, field by field, and later gets the bytes that it
/// compresses.
struct shared_values {
    std::uint64_t first_point = 0;  ///< number, in the whole file, of this part's first point
    std::size_t part = 0;
    std::size_t parts = 1;
    std::function<void(std::uint64_t at, std::span<const std::byte> bytes)> put{};
    std::function<void(std::uint64_t at, std::span<std::byte> bytes)> get{};
};

/// The sizes of the sections of a part of a file.
struct written_part {
    std::uint64_t head = 0;    ///< bytes before its points
    std::uint64_t points = 0;  ///< bytes of its points
    std::uint64_t rows = 0;    ///< bytes of rows that came after `end_part`
};

}  // namespace detail::io

/// Writes a point file in blocks; the same file as `write` for all blocks together. A compressed
/// PCD (if the input was one) is assembled in an unnamed file in /var/tmp, or by parts in their
/// `shared_values`.
class TREEFORM_API point_writer {
  public:
    /// `header` is the header of a `point_reader`, perhaps with columns added or removed. `count`
    /// is the number of points that will be written. Coordinates are written with the types of
    /// their columns in "vertex". But binary formats get doubles if `stored_as` is float64 and none
    /// of these types is wider than float32. `header` also has the number of rows of other elements
    /// to be written; `most_corners` is the largest number of corners of a face.
    ///
    /// \throws io_error as `write`; also for a format other than ply, obj, pcd, las, laz, xyz
    ///         and csv, for LAS without `mesh_file::las` or to a pipe, and for rows of other
    ///         elements in a format other than ply and obj
    point_writer(const std::filesystem::path& path, const mesh_file& header, std::uint64_t count,
                 const write_options& options = {}, std::size_t most_corners = 0);
    ~point_writer();
    point_writer(point_writer&&) noexcept;
    point_writer& operator=(point_writer&&) noexcept;

    /// Writes the next points; `properties` has one row for each.
    ///
    /// \throws io_error if the file cannot be written; std::invalid_argument for columns that
    ///         differ from the header, for more than `count` points, or naming the file and the
    ///         first point with a coordinate that the header's types cannot represent, unless
    ///         `options.precision` requests rounding
    void write(points_view points, const element& properties);
    /// Writes rows of the other elements, after all points, in the order of the header.
    /// \throws io_error; std::invalid_argument for other columns or more rows than in the header
    void write(const row_block& block);
    /// Finishes the file. Without this call, the file is removed.
    /// \throws io_error, also if fewer than `count` points, or fewer rows than in the header, were
    ///         written
    write_result commit();

    /// Whether the file can be written in parts: each by another writer with some of the points.
    [[nodiscard]] bool has_parts() const;
    /// Whether parts need `share_values`: for a compressed PCD, which stores values field by field.
    [[nodiscard]] bool has_shared_values() const;
    /// Sets the shared storage; call it before the first point. `commit_part` compresses this
    /// part's share of the stored bytes; call it after the points of all parts were written.
    /// \throws std::logic_error unless `has_shared_values`, or if points were written
    void share_values(const detail::io::shared_values& place);
    /// The number of points of every part but the last must be a multiple of this: the points of a
    /// chunk for LAZ, else 1.
    [[nodiscard]] std::uint64_t part_granularity() const;
    /// Ends the points of this part; the remaining points are in other parts. Rows that follow the
    /// points of all parts may be written next, rows of earlier parts first. Returns the number of
    /// bytes of the points.
    std::uint64_t end_part();
    /// Skips this many bytes of the file, which others write.
    /// \pre    a regular file, and `end_part` was called
    /// \throws io_error
    void skip_bytes(std::uint64_t bytes);
    /// Data of this part that other parts need for `commit_part`; call it after all points of this
    /// part.
    [[nodiscard]] std::string part_summary();
    /// Finishes the file of a part. The file of a single writer consists of the head from
    /// `join_heads`, the points of all parts, their rows, and the remaining bytes of the last part.
    /// `summaries` are the results of `part_summary` of all parts, in order; needed for LAZ.
    /// \throws io_error; std::logic_error unless `has_parts`
    detail::io::written_part commit_part(write_result& result,
                                         const std::vector<std::string>& summaries = {});
    /// The head of the whole file, from the heads of all parts with points; if no part has points,
    /// from the head of one part.
    [[nodiscard]] static std::string join_heads(const std::vector<std::string>& heads);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Input files that form one cloud, or one mesh; points are numbered file after file.
struct cloud_inputs {
    std::vector<std::filesystem::path> paths{};
    std::string format{};  ///< as for `read`
    /// As in `read_options`.
    std::vector<std::pair<std::string, std::string>> columns{};
    std::vector<std::string> names{};  ///< for warnings; empty: the paths
    bool mixed = false;                ///< as in `concatenate_files`

    /// The joined header of the files, without reading points: as `point_reader::header`, with the
    /// number of rows of each element; the rows of "vertex" are the points. A single file may be a
    /// mesh (`with_rows` of `point_reader`). Text is read once, shared by the ranks. Collective:
    /// every rank must call it.
    ///
    /// \throws io_error of `kind::blocks` as `point_reader`; io_error if a file cannot be read;
    ///         std::invalid_argument for columns that `concatenate_files` cannot unite
    [[nodiscard]] TREEFORM_API mesh_file outline(const communicator& ranks = {}) const;
};

}  // namespace treeform
