#pragma once
/// \file
/// The writer of each format, and what they share.

#include <libmesh/base/nearest_float.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/sink.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// What a writer works on. The checks of `write` have been made.
struct write_job {
    const mesh_file& file;
    const write_options& options;
    write_result& result;
    sink& out;
    std::size_t most_corners = 0;  ///< of faces that come by runs
    /// The element "vertex" in the words of the format, or null; of points by runs without values.
    const element* vertices = nullptr;

    [[nodiscard]] bool single() const { return result.written_as == precision::float32; }
    /// A coordinate in the precision of the job.
    [[nodiscard]] double rounded(double x) const { return single() ? base::nearest_float(x) : x; }
    /// As text: always the digits of the double. The shortest text of a float32 would be another
    /// number to a reader of doubles, so the file would not hold what was computed and checked.
    void coordinate(double x) const { out.number(rounded(x)); }
    void point(const point3& p) const {
        coordinate(p.x);
        out.put(' ');
        coordinate(p.y);
        out.put(' ');
        coordinate(p.z);
    }
};

/// Writes runs of points behind a head that has been written. What the job names must outlive it.
struct point_sink {
    /// The rows that belong to the points; null when the head has no element "vertex".
    std::function<void(std::span<const point3> points, const element* vertices)> rows{};
    std::function<void(const row_block& block)>
        behind{};                    ///< rows of other elements, if any can come
    std::function<void()> finish{};  ///< none: nothing is left to do
    /// Finishes a file that has only some of the points; returns the number of bytes behind them.
    /// `summaries` is what `part_summary` gave for each part.
    std::function<std::uint64_t(const std::vector<std::string>& summaries)> finish_part{};
    std::function<std::string()> part_summary{};  ///< none: nothing
    /// Of values that do not stand point by point: they are put there from now on. None: others do.
    std::function<void(const detail::io::shared_values& place)> share_values{};
    std::uint64_t together = 1;  ///< parts but the last have a multiple of so many points
};

/// The head of a LAS file from those of files with some of its points each, none without any.
[[nodiscard]] std::string join_las_heads(const std::vector<std::string>& heads);

/// Whether it is that of a part of a compressed PCD; and the head of the whole.
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

/// Start a file of `count` points; the points of the job's file are not looked at.
[[nodiscard]] point_sink start_ply_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_obj_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_xyz_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_csv_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_pcd_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_las_points(const write_job& job, std::uint64_t count);
[[nodiscard]] point_sink start_laz_points(const write_job& job, std::uint64_t count);

/// \throws std::invalid_argument for a column that is not as long as the element, or whose name
///         no format can hold
void check_columns(const element& e);

/// Largest change by rounding to float32. `first` is the number of the first point, in errors.
///
/// \throws io_error when a finite coordinate becomes infinite
[[nodiscard]] double largest_move(std::span<const point3> points, std::size_t first,
                                  const std::string& name);

/// Calls f(first triangle, corners) for each face as stored, in order.
template <class F>
void for_each_stored_face(const mesh_file& file, F&& f) {
    const auto& faces = file.mesh.faces;
    const auto& stored = file.stored_face;
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

/// A name or remark as it can stand in one line: with blanks for newlines, which names in a scene
/// may have, and which would make the rest of it a statement.
[[nodiscard]] inline std::string one_line(std::string text) {
    std::replace_if(text.begin(), text.end(), is_newline, ' ');
    return text;
}

/// Where corner `corner` of a polygon is in its fan: which triangle, which of its corners.
[[nodiscard]] constexpr std::pair<std::size_t, std::size_t> place_in_fan(std::size_t corner) {
    return corner < 2 ? std::pair(std::size_t{0}, corner) : std::pair(corner - 2, std::size_t{2});
}

/// Faces as stored.
[[nodiscard]] inline std::size_t stored_face_count(const mesh_file& file) {
    return file.stored_face.empty() ? file.mesh.faces.size()
                                    : file.stored_face.back() + std::size_t{1};
}

/// Row of the element "face" that a triangle belongs to.
[[nodiscard]] inline std::size_t face_row(const mesh_file& file, std::size_t triangle) {
    return file.stored_face.empty() ? triangle : file.stored_face[triangle];
}

/// Value `i` of a column as text.
void put_number(sink& out, const column& c, std::size_t i);

template <std::endian order, class T>
void put_bits_as(sink& out, const column& c, std::size_t i) {
    T bits;
    std::memcpy(&bits, c.values.data() + i * sizeof bits, sizeof bits);
    out.raw<order>(bits);
}

/// Value `i` of a column as it stands, bit for bit: numbers on their way through another type would
/// lose some of NaN.
template <std::endian order>
void put_bits(sink& out, const column& c, std::size_t i) {
    const std::size_t size = size_of(c.type);
    if (size == 1) return put_bits_as<order, std::uint8_t>(out, c, i);
    if (size == 2) return put_bits_as<order, std::uint16_t>(out, c, i);
    if (size == 4) return put_bits_as<order, std::uint32_t>(out, c, i);
    put_bits_as<order, std::uint64_t>(out, c, i);
}

/// The columns of these names, all of them with one value a row; empty when one is missing. The
/// element may be null.
[[nodiscard]] std::vector<const column*> scalar_columns(const element* e,
                                                        std::span<const std::string_view> names);
[[nodiscard]] std::vector<const column*> scalar_columns(const mesh_file& file,
                                                        std::string_view element,
                                                        std::span<const std::string_view> names);

/// Columns red, green, blue, and alpha where there is one, by these names or others that mean the
/// same.
[[nodiscard]] std::vector<const column*> color_columns(const element* e);
[[nodiscard]] std::vector<const column*> color_columns(const mesh_file& file,
                                                       std::string_view element);

/// A color as a number from 0 to 1: whole numbers count 255ths, those of 16 bits 65535ths; others
/// are taken as they are.
[[nodiscard]] inline double color_value(const column& c, std::size_t row) {
    const double value = c.number(row);
    if (c.type == scalar_type::uint16) return value / 65535.0;
    return c.type < scalar_type::float32 ? value / 255.0 : value;
}

}  // namespace treeform::detail::io
