#pragma once
/// \file
/// Reads and writes point files a block at a time, for clouds that are larger than memory; and the
/// faces and other rows that a PLY or STL has behind its points.

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

namespace detail::io {

/// Consecutive points with their properties.
struct point_block {
    std::vector<point3> points{};
    element properties{.name = "vertex"};  ///< a row a point
};

/// Consecutive rows of an element behind the points, such as faces.
struct row_block {
    element rows{};                        ///< with the element's name
    std::vector<std::uint32_t> corners{};  ///< of faces: those of the first, then of the next, ...
    std::vector<std::uint64_t> first_corner{};  ///< [rows + 1] in `corners`; of others empty
    /// Faces of fewer than three corners that were among these: the header counts them.
    std::uint64_t left_out = 0;
};

}  // namespace detail::io

/// Reads PLY without faces, PCD, LAS, LAZ, XYZ and CSV from the first point to the last. All blocks
/// together are what `read` gives for the whole file.
class TREEFORM_API point_reader {
  public:
    /// Reads the header. `path` and `format` as for `read`. Input that cannot be mapped (standard
    /// input, a pipe) is copied to an unnamed file in /var/tmp first; the points of a compressed
    /// PCD are unpacked to one before the first of them is read, so that damage is found then. The
    /// `first` points, no more than there are, are passed over: unread in binary PLY without lists,
    /// PCD except for text, LAS, and whole chunks of LAZ.
    ///
    /// With `with_rows`, a PLY may have faces and other elements behind its points, and a binary
    /// STL is read as the corners of its facets, with the facets behind them. The header says how
    /// many rows there are. They can be read next. The facets of an STL have the column
    /// "stl_attribute" also where all of it is zero.
    ///
    /// \throws io_error of `kind::blocks` for a format without points, for a file with
    ///         faces or other elements that have rows; with `with_rows` for what is ahead of the
    ///         points, for strips of triangles, and for faces with texture coordinates of corners;
    ///         io_error as `read`
    explicit point_reader(const std::filesystem::path& path, std::string_view format = {},
                          std::uint64_t first = 0, bool with_rows = false,
                          const read_options& options = {});
    ~point_reader();
    point_reader(point_reader&&) noexcept;
    point_reader& operator=(point_reader&&) noexcept;

    /// The file without its points: format, precision, comments and columns (without rows).
    /// `stored_as` is by the types in the file, `float64` for text. Text without a header (XYZ,
    /// CSV) is read once to count its lines and to see whether they are alike. Warnings about the
    /// end of the file are there once `read` has returned false.
    [[nodiscard]] const mesh_file& header() const;
    /// Number of points in the file.
    [[nodiscard]] std::uint64_t count() const;
    /// Replaces the content of `points`, and of `properties` with a row for each, by that of the
    /// next points, at most `most`. Returns false, with both empty, when none are left.
    ///
    /// \throws io_error as `read`
    bool read(std::vector<point3>& points, element& properties, std::size_t most);
    /// Likewise, with `with_rows`, the next rows of one element, in the order of the file; passes
    /// over points that have not been read.
    ///
    /// \throws io_error as `read`
    bool read(detail::io::row_block& block, std::size_t most);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

namespace detail::io {

/// A place that all parts see, as large as all values together. Parts put the values of their
/// points there, field by field, and later get the bytes that they pack.
struct shared_values {
    std::uint64_t first_point = 0;  ///< of the part, by number in the whole
    std::size_t part = 0;
    std::size_t parts = 1;
    std::function<void(std::uint64_t at, std::span<const std::byte> bytes)> put{};
    std::function<void(std::uint64_t at, std::span<std::byte> bytes)> get{};
};

/// The bytes of a part of a file.
struct written_part {
    std::uint64_t head = 0;    ///< bytes ahead of its points
    std::uint64_t points = 0;  ///< bytes of its points
    std::uint64_t rows = 0;    ///< bytes of rows that came after `end_part`
};

}  // namespace detail::io

/// Writes the same file as `write` would for all blocks together. A compressed PCD (the input was
/// one) is put together in an unnamed file in /var/tmp, or by parts where they say.
class TREEFORM_API point_writer {
  public:
    /// `header` is that of `point_reader`, perhaps with columns added or removed. `count` is the
    /// number of points that will be written. Coordinates are written with the types of their
    /// columns in "vertex"; in binary as doubles when these are at most float32 and `stored_as` is
    /// float64. Of other elements, the header says how many rows will be written, and
    /// `most_corners` how many a face has at most.
    ///
    /// \throws io_error as `write`; also for a format other than ply, obj, pcd, las, laz, xyz
    ///         and csv, for LAS without `mesh_file::las` or to a pipe, and for rows of other
    ///         elements in a format other than ply and obj
    point_writer(const std::filesystem::path& path, const mesh_file& header, std::uint64_t count,
                 const write_options& options = {}, std::size_t most_corners = 0);
    ~point_writer();
    point_writer(point_writer&&) noexcept;
    point_writer& operator=(point_writer&&) noexcept;

    /// The next points; `properties` has a row for each.
    ///
    /// \throws io_error when the file cannot be written, std::invalid_argument for columns other
    ///         than those of the header, more than `count` points, or a coordinate that the
    ///         header's types do not hold unless `options.precision` says to round
    void write(points_view points, const element& properties);
    /// Rows of the other elements, behind all points, in the order of the header.
    /// \throws io_error, std::invalid_argument for other columns or more rows than the header's
    void write(const detail::io::row_block& block);
    /// Finishes the file. Without this call, no file stays.
    /// \throws io_error, also when fewer than `count` points, or other rows, were written
    write_result commit();

    /// Whether others can write the rest of the points.
    [[nodiscard]] bool has_parts() const;
    /// Whether parts need such a place: those of a compressed PCD, whose values stand field by
    /// field.
    [[nodiscard]] bool has_shared_values() const;
    /// Names it, before the first point. When all parts have their points, and not before,
    /// `commit_part` gets a share of the bytes of all and packs them.
    /// \throws std::logic_error where there is no such place, or points were written
    void share_values(const detail::io::shared_values& place);
    /// All parts but the last must have a multiple of so many points: those of a chunk in LAZ, else
    /// 1.
    [[nodiscard]] std::uint64_t part_granularity() const;
    /// No more points come: the others are in other parts. Rows that are behind the points of all
    /// parts may follow, those of earlier parts first. Returns the bytes of the points.
    std::uint64_t end_part();
    /// Leaves so many bytes of the file to others.
    /// \pre    a regular file, and `end_part` was called
    /// \throws io_error
    void skip_bytes(std::uint64_t bytes);
    /// What must be known of a part to finish others; call it when all of its points are there.
    [[nodiscard]] std::string part_summary();
    /// Finishes a file that has only some of the points. The joined head, the points of all parts,
    /// their rows, and what else is behind those of the last one are what one writer of all would
    /// have written.
    /// `summaries` is what `part_summary` gave for each part, in their order; LAZ needs it.
    /// \throws io_error, std::logic_error where it has no parts
    detail::io::written_part commit_part(write_result& result,
                                         const std::vector<std::string>& summaries = {});
    /// The head of the whole from those of all parts that have points; if none has, from one.
    [[nodiscard]] static std::string join_heads(const std::vector<std::string>& heads);

  private:
    struct state;
    std::unique_ptr<state> state_;
};

/// Files that are one cloud, all points of the first before those of the next.
struct cloud_inputs {
    std::vector<std::filesystem::path> paths{};
    std::string format{};  ///< as for `read`
    /// As in `read_options`.
    std::vector<std::pair<std::string, std::string>> columns{};
    std::vector<std::string> names{};  ///< for warnings; empty: the paths
    bool mixed = false;                ///< as in `join`

    /// What is in the files, before their points are read: the header, as that of a `point_reader`,
    /// whose elements have no values, but as many rows as there are; those of "vertex" are the
    /// points. One file alone may be a mesh, as `point_reader` reads it with rows. Text is read
    /// once, shared by the ranks; every rank must call this.
    ///
    /// \throws io_error of `kind::blocks` for what is no file of points, as
    ///         `point_reader`, io_error for what cannot be read; std::invalid_argument for columns
    ///         that `join` cannot unite
    [[nodiscard]] TREEFORM_API mesh_file outline(const communicator& ranks = {}) const;
};

}  // namespace treeform
