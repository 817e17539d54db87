#pragma once
/// \file
/// The writer of each format, and their common helpers.

#include <libmesh/base/nearest_float.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/sink.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// The arguments of a writer, already checked by `write`.
struct write_job {
    const mesh_file& file;
    const write_options& options;
    write_result& result;
    sink& out;
    /// largest number of corners of faces that are written in blocks
    std::size_t most_corners = 0;
    /// The element "vertex" with the column names of the format, or null; without values for points
    /// in blocks.
    const element* vertices = nullptr;

    [[nodiscard]] bool single() const { return result.written_as == precision::float32; }
    /// A coordinate in the precision of the job.
    [[nodiscard]] double rounded(double x) const { return single() ? base::nearest_float(x) : x; }
    /// Writes a coordinate as text, with the digits of the double: the shortest text of a float32
    /// is another number for readers of doubles, so the file would not have the coordinates that
    /// were computed and checked.
    void coordinate(double x) const { out.number(rounded(x)); }
    void point(const point3& p) const {
        coordinate(p.x);
        out.put(' ');
        coordinate(p.y);
        out.put(' ');
        coordinate(p.z);
    }
};

/// \throws io_error naming the first point that is not finite, which the format cannot hold
void check_finite(const write_job& job, const char* format);

/// Writes blocks of points after a header that was already written. The references in the job must
/// outlive it.
struct point_sink {
    /// Writes points and their rows, which are null if the header has no element "vertex".
    std::function<void(std::span<const point3> points, const element* vertices)> rows{};
    std::function<void(const row_block& block)>
        behind{};                    ///< writes rows of other elements, if the format has any
    std::function<void()> finish{};  ///< not set: there is nothing to do
    /// Finishes the file of a part; returns the number of bytes after its points. `summaries` are
    /// the results of `part_summary` of all parts.
    std::function<std::uint64_t(const std::vector<std::string>& summaries)> finish_part{};
    std::function<std::string()> part_summary{};  ///< not set: an empty summary
    /// Sets the shared storage for formats that do not store values point by point. Not set for
    /// other formats.
    std::function<void(const detail::io::shared_values& place)> share_values{};
    /// the number of points of all parts but the last must be a multiple of this
    std::uint64_t together = 1;
};

/// The header of a LAS file, from the headers of its parts, each of which has points.
[[nodiscard]] std::string join_las_heads(const std::vector<std::string>& heads);

/// Whether a header is that of a part of a compressed PCD; and the header of the whole file.
[[nodiscard]] bool is_packed_pcd_head(std::string_view head);
[[nodiscard]] std::string join_packed_pcd_heads(const std::vector<std::string>& heads);

void write_stl_binary(const write_job& job);
void write_stl_text(const write_job& job);
void write_obj(const write_job& job);
void write_ply(const write_job& job);
void write_off(const write_job& job);
void write_xyz(const write_job& job);
void write_glb(const write_job& job);
void write_3mf(const write_job& job);
void write_csv(const write_job& job);
void write_pcd(const write_job& job);
void write_las(const write_job& job);
void write_laz(const write_job& job);

/// Begin a file of `count` points; the points of the job's file are ignored.
[[nodiscard]] point_sink start_ply_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_obj_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_xyz_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_csv_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_pcd_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_las_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_laz_points(const write_job& job, std::uint64_t count);

/// \throws std::invalid_argument for a column of another length than the element, or with a name
///         that no format can store
void check_columns(const element& e);

/// The largest change of a coordinate by rounding to float32. `first` is the number of the first
/// point, for errors.
///
/// \throws io_error if a finite coordinate becomes infinite
[[nodiscard]] double largest_move(std::span<const point3> points, std::size_t first,
                                  const std::string& name);

/// Calls f(first triangle, corners) for each face as stored, in order.
template <class F>
void for_each_stored_face(const mesh_file& file, F&& f) {
    const auto& faces = file.mesh.faces;
    const auto& stored = file.face_of_triangle;
    std::vector<std::uint32_t> corners;
    for (std::size_t first = 0; first < faces.size();) {
        corners.assign(faces[first].begin(), faces[first].end());
        std::size_t next = first + 1;
        if (!stored.empty())
            for (; next < faces.size() && stored[next] == stored[first]; ++next)
                corners.push_back(faces[next][2]);
        f(first, std::span<const std::uint32_t>(corners));
        first = next;
    }
}

/// A name or remark in a single line: newlines, which names in scenes may contain, are replaced by
/// blanks, since the rest would become a statement of its own.
[[nodiscard]] inline std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), is_newline, ' ');
    return text;
}

/// The position of corner `corner` of a polygon in its fan: the triangle, and the corner of that.
[[nodiscard]] constexpr std::pair<std::size_t, std::size_t> place_in_fan(std::size_t corner) {
    return corner < 2 ? std::pair(std::size_t{0}, corner) : std::pair(corner - 2, std::size_t{2});
}

/// Number of stored faces.
[[nodiscard]] inline std::size_t stored_face_count(const mesh_file& file) {
    return file.face_of_triangle.empty() ? file.mesh.faces.size()
                                         : file.face_of_triangle.back() + std::size_t{1};
}

/// The row of a triangle in the element "face".
[[nodiscard]] inline std::size_t face_row(const mesh_file& file, std::size_t triangle) {
    return file.face_of_triangle.empty() ? triangle : file.face_of_triangle[triangle];
}

/// Writes value `i` of a column as text.
void put_number(sink& out, const column& c, std::size_t i);

/// Value `i` of a column as it stands, bit for bit.
template <std::endian order>
void put_bits(sink& out, const column& c, std::size_t i) {
    with_bits(c.type, [&]<class T>(T bits) {
        std::memcpy(&bits, c.values.data() + i * sizeof bits, sizeof bits);
        out.raw<order>(bits);
    });
}

/// The columns with these names, if all exist and have one value a row; else empty. The element may
/// be null.
[[nodiscard]] std::vector<const column*> scalar_columns(
    const element* e, std::initializer_list<std::string_view> names);

/// The columns red, green, blue and, if it exists, alpha, by these names or their synonyms.
[[nodiscard]] std::vector<const column*> color_columns(const element* e);

/// A color value from 0 to 1: integers are divided by 255, those of 16 bits by 65535; floats are
/// unchanged.
[[nodiscard]] inline double color_value(const column& c, std::size_t row) {
    const double value = c.number(row);
    if (c.type == scalar_type::uint16) return value / 65535.0;
    return c.type < scalar_type::float32 ? value / 255.0 : value;
}

/// Writes rows 0 to `rows` to the sink of `job`, in order. `put(piece, first, last)` writes some
/// rows to the sink of `piece`, which is `job` with another sink. Pieces are written while the next
/// ones are serialized.
///
/// \pre  `put` only changes the sink, since it is called from several threads
/// \same on any number of threads
template <class Put>
void put_by_pieces(const write_job& job, std::size_t rows, const Put& put) {
    constexpr std::size_t rows_of_piece = std::size_t{1} << 12;
    constexpr std::size_t pieces_at_once = 32;
    if (rows <= rows_of_piece) return put(job, std::size_t{0}, rows);
    std::array<std::vector<std::string>, 2> turns;  // one is made, the other one is written
    for (auto& texts : turns) texts.resize(pieces_at_once);
    const std::size_t pieces = chunk_count(rows, rows_of_piece);
    for (std::size_t done = 0, turn = 0; done < pieces; done += pieces_at_once, turn ^= 1) {
        const std::size_t some = std::min(pieces_at_once, pieces - done);
        for_chunks(some + 1, 1, [&](std::size_t task, auto, auto) {
            if (task == 0) {
                for (std::string& text : turns[turn ^ 1]) {
                    job.out.put(text);
                    text.clear();
                }
                return;
            }
            std::string& text = turns[turn][task - 1];
            sink out(text);
            const write_job piece{job.file, job.options, job.result, out};
            const std::size_t first = (done + task - 1) * rows_of_piece;
            put(piece, first, std::min(first + rows_of_piece, rows));
            out.flush();
        });
    }
    for (const auto& texts : turns)
        for (const std::string& text : texts) job.out.put(text);
}

/// The columns of the element "vertex" to be written: those of the file, without values, and those
/// of the coordinates. Missing coordinate columns are added before all others.
///
/// `points` are all points; none if they will be written in blocks. Declared types are kept where
/// possible: text may have more digits than the type, binary data may not.
[[nodiscard]] element declare_vertices(const write_job& job, bool text,
                                       std::optional<std::span<const point3>> points);

/// The coordinates whose column type cannot represent all of `points`.
[[nodiscard]] std::array<bool, 3> outgrown_axes(const element& declared,
                                                std::span<const point3> points);

/// A point of a block that the declared types cannot represent.
struct unfit_point {
    std::size_t point = 0;  ///< within the block
    std::string reason{};
};

/// Checks points written in blocks, whose types were chosen before the points were known.
///
/// \throws unfit_point for the first one
void check_axes(const write_job& job, bool text, const element& declared,
                std::span<const point3> points);

/// The column of values of the declared data column `i`.
[[nodiscard]] inline const column& with_values(const element& declared, const element* source,
                                               std::size_t i) {
    return source->columns[i - (declared.columns.size() - source->columns.size())];
}

/// Whether a text format writes a column with the digits of a double regardless of its type.
[[nodiscard]] inline bool keeps_digits(const column& c) {
    return c.role != column_role::data && c.type == scalar_type::float32;
}

}  // namespace treeform::detail::io
