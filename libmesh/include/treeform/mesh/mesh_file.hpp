#pragma once
/// \file
/// The content of a mesh or point file: points, triangles, attributes, parts of a scene, the LAS
/// header. File errors. The communicator of processes that share a job.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace treeform {

/// Thrown if a file cannot be read or written, or if a job that stores tiles in a folder
/// (`weld_stream`, `self_intersections_of_file`) cannot continue. `what()` names the path, the line
/// or byte, and the reason: "part.obj:17: vertex index 0 (OBJ counts from 1)".
class TREEFORM_API io_error : public std::runtime_error {
  public:
    enum class kind : std::uint8_t {
        file,    ///< the file cannot be opened, read or written, or its content is invalid
        blocks,  ///< not a point file, or a format that cannot be read in blocks; use `read`
        /// the folder of a job in tiles cannot be created or written (this and all following kinds
        /// are errors of such jobs)
        folder,
        folder_in_use,   ///< another process uses the folder
        folder_foreign,  ///< the folder contains files of another program or another job
        tile_write,      ///< a tile cannot be written
        tile_read,       ///< a tile cannot be read
        tile_damaged,    ///< a tile has changed since it was written
        memory,          ///< the memory limit is too low; `needed()` bytes would suffice
        input_changed    ///< the input changed during the job
    };

    using std::runtime_error::runtime_error;
    /// An error of the operating system.
    io_error(const std::string& path, std::error_code reason)
        : std::runtime_error(path + ": " + reason.message()), reason_(reason), path_(path) {}
    io_error(kind why, std::string path, const std::string& text, std::uint64_t needed = 0)
        : std::runtime_error(text), why_(why), path_(std::move(path)), needed_(needed) {}

    [[nodiscard]] kind why() const { return why_; }
    /// The error of the operating system; zero if the content of the file is the reason.
    [[nodiscard]] std::error_code reason() const { return reason_; }
    /// Path of the file if `reason()` is not zero, or of a folder or tile; else empty.
    [[nodiscard]] const std::string& path() const { return path_; }
    /// For `kind::memory`: bytes of memory that would suffice.
    [[nodiscard]] std::uint64_t needed() const { return needed_; }

  private:
    kind why_ = kind::file;
    std::error_code reason_{};
    std::string path_{};
    std::uint64_t needed_ = 0;
};

/// A remark about a file that was read or written.
struct io_warning {
    std::string code;  ///< stable, for scripts: "trailing-bytes", "precision"
    std::string text;  ///< for people
};

/// A variable length record (VLR), plain or extended, for example with the coordinate system.
struct las_record {
    /// such as "LASF_Projection"; at most 16 bytes, including any after a zero byte
    std::string user_id{};
    std::uint16_t record_id = 0;
    std::string description{};  ///< at most 32 bytes, including any after a zero byte
    std::uint16_t reserved = 0;
    std::vector<std::byte> data{};
    friend bool operator==(const las_record&, const las_record&) = default;
};

/// The header of a LAS file, and its records. `write` uses the version, point data format, scale
/// and offset of the header that was read; counts and bounds are computed from the points.
///
/// Dimensions of points are columns of the element "vertex": intensity, return_number,
/// number_of_returns, scan_direction_flag, edge_of_flight_line, classification, synthetic,
/// key_point, withheld, overlap, scanner_channel, scan_angle_rank (formats 0 to 5), scan_angle (6
/// to 10), user_data, point_source_id, gps_time, red, green, blue, nir, wave_packet_index,
/// wave_packet_offset, wave_packet_size, wave_return_location, wave_x, wave_y, wave_z. Extra bytes
/// are columns with the names and types in their record. With a scale or an offset, a column has
/// the scaled values as doubles, NaN for the record's "no data" value; written values are rounded
/// to multiples of the scale. Extra bytes without a record are columns "extra_bytes[0]",
/// "extra_bytes[1]", ...
struct las_header {
    std::uint8_t version_minor = 2;  ///< 0 to 4, for LAS 1.0 to 1.4
    std::uint8_t point_format = 0;   ///< 0 to 10
    /// A coordinate is (X * scale) + offset for a 32-bit integer X; the product is rounded to
    /// double, then the sum.
    std::array<double, 3> scale{0.001, 0.001, 0.001};
    std::array<double, 3> offset{};
    /// The public header block as in the file, including bytes that a later version or a program
    /// added; empty if the header was not read from a file.
    std::vector<std::byte> block{};
    std::vector<las_record> records{};
    std::vector<std::byte> behind_records{};  ///< bytes between the records and the first point
    std::vector<las_record> extended_records{};
    friend bool operator==(const las_header&, const las_header&) = default;
};

/// The range of the values of a column of points.
struct value_range {
    std::string column{};
    double min = 0.0;
    double max = 0.0;
    bool whole = true;  ///< all values are integers

    friend bool operator==(const value_range&, const value_range&) = default;
};

/// How to read.
struct read_options {
    /// For XYZ, PTS and CSV: names of columns, as pairs of the new name and the name in the first
    /// line or the column number, from 1: {"x", "easting"}. Columns x, y and z are the coordinates.
    std::vector<std::pair<std::string, std::string>> columns{};
    /// Drop points with a coordinate that is not finite, and their faces, and add a warning. Only
    /// for `read`.
    bool drop_non_finite = false;
};

/// The content of a file. Points and faces have the order and numbers of the file: nothing is
/// joined, split, reordered or dropped.
struct mesh_file {
    treeform::mesh mesh{};  ///< polygons become triangle fans from their first corner
    /// [F] the number in the file of the face that each triangle comes from; empty if all faces are
    /// triangles.
    std::vector<std::uint32_t> face_of_triangle{};
    std::size_t stored_faces = 0;  ///< faces in the file
    bool indexed = true;           ///< the format numbers its vertices (STL does not)
    /// float32 if every coordinate is a float32 value, or was one before its node's transform.
    precision stored_as = precision::float64;
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    std::vector<io_warning> warnings{};
    treeform::attributes attributes{};  ///< all other data of the file
    std::optional<las_header> las{};    ///< header, if the file is LAS or LAZ
    /// Ranges of colors and intensities whose type does not determine their scale (floats, and
    /// colors of 16 bits). `write` uses them to scale values for another format; for columns
    /// without an entry it uses the range of the values that it writes.
    std::vector<value_range> ranges{};

    /// Makes each triangle a face of its own, so that each can get its own value. The row of a
    /// polygon in the element "face" is repeated for its triangles, parts are renumbered, and
    /// `face_of_triangle` becomes empty.
    TREEFORM_API void split_polygons();

    /// Drops points with a NaN or infinite coordinate, and faces with such a corner. Returns the
    /// number of dropped points.
    TREEFORM_API std::size_t drop_non_finite();

    /// Rounds every point to float32. Returns the largest change of a coordinate.
    TREEFORM_API double round_to_float32();

    /// Transforms the points, and the normals as `transform_normals` does. If `by` mirrors, faces
    /// are flipped, with the values of their corners, so that they still point outward.
    TREEFORM_API void move(const transform<3>& by);

    /// Transforms normals by `by`, and keeps their lengths: the columns nx, ny, nz of all elements,
    /// and the normals of corners. If `by` mirrors, outward normals stay outward, as for flipped
    /// faces.
    TREEFORM_API void transform_normals(const transform<3>& by);
};

/// Whether every coordinate is exactly representable in float32, NaN or infinite.
[[nodiscard]] TREEFORM_API bool fits_float32(std::span<const point3> points);

/// Several processes (ranks) that share a job, through a folder that all can access. All ranks call
/// the same function with the same options. Outputs are written to the paths of rank 0. If a rank
/// fails, `exchange` must throw in all others.
struct communicator {
    std::size_t rank = 0;
    std::size_t size = 1;
    /// All-gather: sends the string to all ranks, and returns the strings of all ranks, in their
    /// order. Collective: every rank must call it.
    std::function<std::vector<std::string>(const std::string&)> exchange{};
};

}  // namespace treeform
