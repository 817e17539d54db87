#pragma once
/// \file
/// Reads the points of a file sequentially, in blocks; common to the readers of whole point files
/// and of streams.

#include <libmesh/io/detect.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <array>
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

namespace treeform::detail::io {

/// The treatment of rows of a PLY other than points.
enum class row_use : std::uint8_t {
    none,    ///< a file with such rows is refused
    copied,  ///< rows after the points are read; refused if they could not be written the same way
    read     ///< rows after the points are read, rows before them are skipped
};

/// Fills `bytes` with the data from `at` on.
using byte_getter = std::function<void(std::uint64_t at, std::span<std::byte> bytes)>;

/// Consecutive points with their properties.
struct point_block {
    std::vector<point3> points{};
    element properties{.name = "vertex"};  ///< one row for each point
};

struct point_rows {
    /// The file without its points; the element "vertex", if any, has columns without values.
    mesh_file head{};
    std::uint64_t count = 0;
    std::uint64_t left_out = 0;  ///< number of skipped points
    /// Appends the next points, at most `most`, and their rows to the columns of `vertices`, which
    /// are those of the head; returns their number. Returns zero at the end, after adding warnings
    /// about the end of the file.
    std::function<std::size_t(std::vector<point3>& points, element& vertices, std::size_t most,
                              std::vector<io_warning>& warnings)>
        append{};
    /// Replaces the content of `block` by the next rows after the points; points that have not been
    /// read are skipped. Returns false at the end. Not set if there are only points.
    std::function<bool(row_block& block, std::size_t most, std::vector<io_warning>& warnings)>
        behind{};
    /// The position of the next row after the points; points that have not been read are skipped.
    /// This and the next two are set if `behind` is. \throws io_error
    std::function<row_place()> next_row{};
    /// Continues at a row reported by a reader of the same file.
    std::function<void(const row_place&)> go_to{};
    /// Divides the rows into `count` parts of about equal size in bytes, reading at most one row.
    /// Returns the begin of each part and the end of the last: `count + 1` positions. Empty if the
    /// rows have to be read for that: in text and with lists of points without an index, with lists
    /// of other values, or if faces cannot all have as many corners as the first one. Otherwise
    /// that is assumed, and other faces are refused from then on. \pre no row was read
    /// \throws io_error
    std::function<std::vector<row_place>(std::size_t count)> row_parts{};
};

/// Open a file for reading points in blocks. `in` must outlive the result. The points before
/// `first` are skipped where that requires no reading; in text, and for points with lists, those
/// before the last suitable mark of `known`, the index of records, which must outlive the result.
/// XYZ is read once if there is no index.
///
/// \throws io_error; of `kind::blocks` also for a PLY with rows that `use` does not allow, as
///         `point_reader`
[[nodiscard]] point_rows open_ply_points(const source& in, std::uint64_t first = 0,
                                         row_use use = row_use::none,
                                         const record_index* known = nullptr);
/// Whether `row_use::read` is possible: vertices precede faces, and there are no triangle
/// strips.
/// \throws io_error
[[nodiscard]] bool has_readable_rows(const source& ply);
/// The corners of a binary STL, followed by its facets.
[[nodiscard]] point_rows open_stl_points(const source& in, std::uint64_t first = 0);
/// `unpacked` returns the points of a compressed file, if another process unpacked them.
[[nodiscard]] point_rows open_pcd_points(const source& in, std::uint64_t first = 0,
                                         const record_index* known = nullptr,
                                         const byte_getter* unpacked = nullptr);
[[nodiscard]] point_rows open_las_points(const source& in, std::uint64_t first = 0);
[[nodiscard]] point_rows open_xyz_points(
    const source& in, std::string_view format, std::uint64_t first = 0,
    const record_index* known = nullptr,
    std::span<const std::pair<std::string, std::string>> columns = {});

/// Whether the points of a binary PLY have lists, so that their positions are only known after
/// reading all points before. \throws io_error
[[nodiscard]] bool has_listed_points(const source& ply);
struct listed_points {
    record_index found{};
    row_place next{};  ///< the first point after them; its row is counted in the element
};
/// Indexes such points from `first` (byte 0: the first point) to the first one that begins at or
/// after byte `end`; a few more may be read. Sets at most `most` + 1 marks.
/// \throws io_error
[[nodiscard]] listed_points scan_listed_points(const source& ply, const row_place& first,
                                               std::uint64_t end, std::size_t most);

/// Index the lines that begin in a part of a text of points; none if the file is not text. Set at
/// most `most` marks. If XYZ is not `even` before the part, only coordinates are parsed.
/// \throws io_error, for XYZ for any invalid line
[[nodiscard]] std::optional<record_index> scan_ply(const source& in, const file_part& part,
                                                   std::size_t most);
[[nodiscard]] std::optional<record_index> scan_pcd(const source& in, const file_part& part,
                                                   std::size_t most);
[[nodiscard]] record_index scan_xyz(
    const source& in, std::string_view format, const file_part& part, std::size_t most,
    bool even = true, std::span<const std::pair<std::string, std::string>> columns = {});

/// All points of a file that has a row of "vertex" for each. \throws io_error
[[nodiscard]] mesh_file read_all(const source& in, point_rows rows);

[[noreturn]] inline void fail_in_blocks(const source& in, std::string_view reason) {
    throw io_error(io_error::kind::blocks, std::string(in.name()),
                   std::string(in.name()) + ": " + std::string(reason));
}

/// A triangle of a file, with its positions; a polygon has several.
struct placed_triangle {
    std::uint32_t stored = 0;  ///< number of the face in the file
    face corners{};            ///< point numbers in the file
    std::array<point3, 3> at{};
};

/// Storage for the points of a PLY while its faces are read.
class point_store {
  public:
    virtual ~point_store() = default;
    /// Adds the points of this part, in order.
    virtual void put(points_view points) = 0;
    /// A point of the file; call it after all parts have put theirs.
    [[nodiscard]] virtual point3 at(std::uint32_t point) = 0;
};

/// The faces of a part of a file; all parts together have all triangles.
struct face_rows {
    mesh_file
        head{};  ///< format, precision and warnings; for PLY, the precision is that of the part
    std::uint64_t points = 0;        ///< of the file
    std::uint64_t stored_faces = 0;  ///< of the file
    std::optional<box3> bounds{};    ///< box of all finite points, if these precede the faces
    std::vector<point3>
        sample{};  ///< finite corners spread over the part; at most `sample_size` for the file
    /// Appends the next triangles, about `most`. Returns false if none are left; the last part then
    /// added the warnings about the end of the file.
    std::function<bool(std::vector<placed_triangle>& triangles, std::size_t most,
                       std::vector<io_warning>& warnings)>
        append{};
    /// For PLY: number of skipped faces with fewer than three corners.
    std::function<std::uint64_t()> left_out{};
    /// For PLY: as in `point_rows`.
    std::function<std::vector<row_place>(std::size_t count)> row_parts{};
    /// For PLY: restricts `append` to the rows from `first` up to row `end`; the end of the file is
    /// checked after the last row. If it is not called, all rows are read.
    std::function<void(const row_place& first, std::optional<std::uint64_t> end)> go_to{};
};

inline constexpr std::size_t sample_size = std::size_t{1} << 17;

/// Open a file for reading faces in blocks. `in` and `known`, the index of its records, must
/// outlive the result. For an STL, the faces of the part are read. For a PLY, the points of the
/// part are put into the store that `make_store` returns for their number.
///
/// \throws io_error; of `kind::blocks` for a PLY for which `has_readable_rows` is false
[[nodiscard]] face_rows open_stl_faces(const source& in, const file_part& part = {});
[[nodiscard]] face_rows open_ply_faces(
    const source& in, const std::function<std::unique_ptr<point_store>(std::size_t)>& make_store,
    const file_part& part = {}, const record_index* known = nullptr);

/// The implementation of `point_reader`.
class point_blocks {
  public:
    /// As for `point_reader`; `known` as for `open_xyz_points`, `unpacked` for `open_pcd_points`.
    point_blocks(const std::filesystem::path& path, const reading& how, std::uint64_t first,
                 row_use use, const record_index* known = nullptr,
                 const byte_getter* unpacked = nullptr);
    point_blocks(const point_blocks&) = delete;
    point_blocks& operator=(const point_blocks&) = delete;

    [[nodiscard]] const mesh_file& header() const { return rows_.head; }
    [[nodiscard]] std::uint64_t count() const { return rows_.count; }
    bool read(point_block& block, std::size_t most);
    bool read(row_block& block, std::size_t most) {
        return rows_.behind && rows_.behind(block, most, rows_.head.warnings);
    }
    [[nodiscard]] row_place next_row() { return rows_.next_row ? rows_.next_row() : row_place{}; }
    void go_to(const row_place& place) {
        if (rows_.go_to) rows_.go_to(place);
    }
    [[nodiscard]] std::vector<row_place> row_parts(std::size_t count) {
        return rows_.row_parts ? rows_.row_parts(count) : std::vector<row_place>();
    }

  private:
    source in_;  ///< declared before `rows_`, which reads from it
    point_rows rows_;
};

/// The index of the records of a part of a text file, with at most `most` marks. None if the file
/// is no text of points, or cannot be read, which is reported when it is opened. `even` as for
/// `scan_xyz`.
[[nodiscard]] std::optional<record_index> scan_points(const std::filesystem::path& path,
                                                      const reading& how, const file_part& part,
                                                      std::size_t most, bool even = true);

/// Whether the file is a PLY for which `has_listed_points`; false if it cannot be read.
[[nodiscard]] bool has_listed_points_at(const std::filesystem::path& path, const reading& how);

}  // namespace treeform::detail::io
