#pragma once
/// \file
/// The points of a file from the front to the back, a run at a time; what the readers of whole
/// point files and of streams have in common.

#include <libmesh/io/file_part.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/point_stream.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// What is done with rows of a PLY other than points.
enum class row_use : std::uint8_t {
    none,      ///< a file that has any is refused
    copied,    ///< those behind the points are read; where they could not be written so, refused
    looked_at  ///< those behind the points are read, and what is ahead is passed over
};

/// Fills `bytes` with those from `at` on.
using byte_getter = std::function<void(std::uint64_t at, std::span<std::byte> bytes)>;

struct point_rows {
    /// Everything but the points; the element "vertex", if any, has columns without values.
    mesh_file head{};
    std::uint64_t count = 0;
    std::uint64_t left_out = 0;  ///< points that were passed over
    /// Appends the next points, at most `most` of them, and their rows to the columns of
    /// `vertices`, which are those of the head; returns how many. Zero at the end, where `warnings`
    /// gets what was to be said.
    std::function<std::size_t(std::vector<point3>& points, element& vertices, std::size_t most,
                              std::vector<io_warning>& warnings)>
        append{};
    /// Replaces the content of `block` by the next rows behind the points; what of these has not
    /// been read is passed over. False at the end. None where there is nothing to read but points.
    std::function<bool(row_block& block, std::size_t most, std::vector<io_warning>& warnings)>
        behind{};
    /// The next row behind the points; points that have not been read are passed over. This and the
    /// next two are there where `behind` is. \throws io_error
    std::function<row_place()> next_row{};
    /// Goes on at a row that a reader of the same file has reported.
    std::function<void(const row_place&)> go_to{};
    /// Where `count` parts of the rows begin, of about as many bytes each, and where the last one
    /// ends: `count + 1` places, found without reading more than a row. Empty where the rows have
    /// to be read: in text and with lists of points where nothing is known of them, with lists of
    /// other values, and where not all faces can have as many corners as the first one. That they
    /// have is taken for granted, and refused from then on where it is not so. \pre no row was
    /// read.
    /// \throws io_error
    std::function<std::vector<row_place>(std::size_t count)> row_parts{};
};

/// What there is to read by runs. `in` must outlive what comes back. The `first` points, which are
/// there, are passed over where that takes no reading; of text, and of points with lists, those
/// ahead of the last mark of what is `known` of them, which must outlive what comes back. XYZ is
/// read once if nothing is.
///
/// \throws io_error; of `kind::blocks` also for a PLY that has rows which `use` has not, as
///         `point_reader`
[[nodiscard]] point_rows open_ply_points(const source& in, std::uint64_t first = 0,
                                         row_use use = row_use::none,
                                         const record_index* known = nullptr);
/// Whether rows can be looked at: vertices come ahead of faces, and these are no triangle strips.
/// \throws io_error
[[nodiscard]] bool has_rows_to_look_at(const source& ply);
/// The corners of a binary STL, facets behind them.
[[nodiscard]] point_rows open_stl_points(const source& in, std::uint64_t first = 0);
/// `unpacked` gives those of a compressed one, if others have unpacked them.
[[nodiscard]] point_rows open_pcd_points(const source& in, std::uint64_t first = 0,
                                         const record_index* known = nullptr,
                                         const byte_getter* unpacked = nullptr);
[[nodiscard]] point_rows open_las_points(const source& in, std::uint64_t first = 0);
[[nodiscard]] point_rows open_xyz_points(
    const source& in, std::string_view format, std::uint64_t first = 0,
    const record_index* known = nullptr,
    std::span<const std::pair<std::string, std::string>> columns = {});

/// Whether the points of a PLY are rows of bytes with lists, so that only who has read those ahead
/// knows where one begins. \throws io_error
[[nodiscard]] bool has_listed_points(const source& ply);
struct listed_points {
    record_index found{};
    row_place next{};  ///< the first point behind them; its row is that of the element
};
/// Looks at such points from `first` on, a byte of zero being where they begin, up to the first
/// that begins at byte `end` or behind it; some more are looked at. Marks are at most `most`, and
/// one.
/// \throws io_error
[[nodiscard]] listed_points scan_listed_points(const source& ply, const row_place& first,
                                               std::uint64_t end, std::size_t most);

/// Looks at the lines that begin in a part of a text of points; none where it is no text. Marks are
/// at most `most`. Unless XYZ is `even` ahead of the part, its lines are looked at up to the
/// coordinates.
/// \throws io_error, of XYZ for any line
[[nodiscard]] std::optional<record_index> scan_ply(const source& in, const file_part& part,
                                                   std::size_t most);
[[nodiscard]] std::optional<record_index> scan_pcd(const source& in, const file_part& part,
                                                   std::size_t most);
[[nodiscard]] record_index scan_xyz(
    const source& in, std::string_view format, const file_part& part, std::size_t most,
    bool even = true, std::span<const std::pair<std::string, std::string>> columns = {});

[[noreturn]] inline void fail_in_blocks(const source& in, std::string_view reason) {
    throw io_error(io_error::kind::blocks, std::string(in.name()),
                   std::string(in.name()) + ": " + std::string(reason));
}

}  // namespace treeform::detail::io
