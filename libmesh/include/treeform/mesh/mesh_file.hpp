#pragma once
/// \file
/// The content of a mesh or point file: points, triangles, attributes, parts of a scene; how LAS
/// stores points. Errors of files. Processes that work on files together.

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

/// A file that cannot be read or written, or work in tiles that cannot go on; `what()` names the
/// path, the line or byte, and the reason: "part.obj:17: vertex index 0 (OBJ counts from 1)".
class TREEFORM_API io_error : public std::runtime_error {
  public:
    enum class kind : std::uint8_t {
        file,    ///< it cannot be opened, read or written, or its content is wrong
        blocks,  ///< no file of points, or none that can be read in blocks: `read` takes all of it
        folder,  ///< of work in tiles, as all that follow: it cannot be made or written to
        folder_in_use,   ///< another process uses it
        folder_foreign,  ///< it holds files of others
        tile_write,      ///< a tile cannot be written
        tile_read,       ///< a tile cannot be read
        tile_damaged,    ///< a tile has changed since it was written
        memory,          ///< it is not enough; `needed()` would be
        input_changed    ///< the input has changed while it was worked on
    };

    using std::runtime_error::runtime_error;
    /// The system does not let it be opened, read or written.
    io_error(const std::string& path, std::error_code reason)
        : std::runtime_error(path + ": " + reason.message()), reason_(reason), path_(path) {}
    io_error(kind why, std::string path, const std::string& text, std::uint64_t needed = 0)
        : std::runtime_error(text), why_(why), path_(std::move(path)), needed_(needed) {}

    [[nodiscard]] kind why() const { return why_; }
    /// Of the system; none where the reason is in the file.
    [[nodiscard]] std::error_code reason() const { return reason_; }
    /// Of the file, where there is a `reason`, and of tiles; else empty.
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Bytes of memory that would be enough.
    [[nodiscard]] std::uint64_t needed() const { return needed_; }

  private:
    kind why_ = kind::file;
    std::error_code reason_{};
    std::string path_{};
    std::uint64_t needed_ = 0;
};

/// Something that a person should know about a file that was read or written.
struct io_warning {
    std::string code;  ///< stable, for scripts: "trailing-bytes", "precision"
    std::string text;  ///< for people
};

/// A variable length record, plain or extended, such as one that names a coordinate system.
struct las_record {
    std::string user_id{};  ///< "LASF_Projection"; at most 16 bytes, with what stands behind a zero
    std::uint16_t record_id = 0;
    std::string description{};  ///< at most 32 bytes, likewise
    std::uint16_t reserved = 0;
    std::vector<std::byte> data{};
    friend bool operator==(const las_record&, const las_record&) = default;
};

/// The header of a LAS file, and its records. A file is written with the header that was read: with
/// its version, point data format, scale and offset; counts and bounds are those of the points.
///
/// Dimensions of points are columns of the element "vertex": intensity, return_number,
/// number_of_returns, scan_direction_flag, edge_of_flight_line, classification, synthetic,
/// key_point, withheld, overlap, scanner_channel, scan_angle_rank (formats 0 to 5), scan_angle (6
/// to 10), user_data, point_source_id, gps_time, red, green, blue, nir, wave_packet_index,
/// wave_packet_offset, wave_packet_size, wave_return_location, wave_x, wave_y, wave_z. Extra bytes
/// are columns with the names and types that their record gives them; those to which it gives a
/// scale or an offset are doubles, the values, NaN where it says that there is none, and are stored
/// in the steps of that scale. Those that no record describes are "extra_bytes[0]" and so on.
struct las_header {
    std::uint8_t version_minor = 2;  ///< of 1.0 to 1.4
    std::uint8_t point_format = 0;   ///< 0 to 10
    /// Coordinates are (X * scale) + offset for whole numbers X of 32 bits, the product rounded to
    /// a double, then the sum.
    std::array<double, 3> scale{0.001, 0.001, 0.001};
    std::array<double, 3> offset{};
    /// The header block as in the file, with what a version or program has added to it; empty when
    /// there was no file.
    std::vector<std::byte> block{};
    std::vector<las_record> records{};
    std::vector<std::byte> behind_records{};  ///< up to the first point
    std::vector<las_record> extended_records{};
    friend bool operator==(const las_header&, const las_header&) = default;
};

/// Least and greatest of a column of points.
struct value_range {
    std::string column{};
    double least = 0.0;
    double greatest = 0.0;
    bool whole = true;  ///< all are whole numbers

    friend bool operator==(const value_range&, const value_range&) = default;
};

/// How to read.
struct read_options {
    /// Of XYZ, PTS and CSV: names for columns, each with what the heading calls the column, or its
    /// number, from 1: {"x", "easting"}. Those for x, y and z are the coordinates.
    std::vector<std::pair<std::string, std::string>> columns{};
    bool drop_non_finite =
        false;  ///< `mesh_file::drop_non_finite`, which a warning says; of `read` alone
};

/// The content of a file. Points and faces keep the order and the numbers that they have in it:
/// nothing is joined, split, reordered or dropped.
struct mesh_file {
    treeform::mesh mesh{};  ///< polygons are cut into a fan from their first corner
    /// [F] the file's number of the face that each triangle comes from; empty when all faces are
    /// triangles.
    std::vector<std::uint32_t> stored_face{};
    std::size_t stored_faces = 0;  ///< faces in the file
    bool indexed = true;           ///< the format numbers its vertices (STL does not)
    /// float32 when every coordinate is a float32 value, or was one before the transform of its
    /// node.
    precision stored_as = precision::float64;
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    std::vector<io_warning> warnings{};
    treeform::attributes attributes{};  ///< everything else that was read
    std::optional<las_header> las{};    ///< of LAS and LAZ
    /// Of colors and intensities whose scale shows in their values alone. Another format is written
    /// by what is here; what is not here is looked for in the columns.
    std::vector<value_range> ranges{};

    /// Makes each triangle a face of its own, for callers who then give each triangle a value. Rows
    /// of the element "face" are repeated for the triangles of a polygon, parts are renumbered, and
    /// `stored_face` becomes empty.
    TREEFORM_API void split_polygons();

    /// Drops the points with a coordinate that is NaN or infinite, and the faces with such a
    /// corner. Returns how many points those were.
    TREEFORM_API std::size_t drop_non_finite();

    /// Rounds every point to float32. Returns the largest change of a coordinate.
    TREEFORM_API double round_to_float32();

    /// Moves all of the file: its points, and its normals as `turn_normals`. Where `by` mirrors,
    /// faces are turned over, with the values of their corners, so that they look outward as
    /// before.
    TREEFORM_API void move(const transform<3>& by);

    /// Turns normals as `by` does, and keeps their lengths: the columns nx, ny, nz of all elements,
    /// and the normals of corners. By a mirror, what looked outward does so still, as faces do that
    /// are turned over.
    TREEFORM_API void turn_normals(const transform<3>& by);
};

/// Whether float32 holds every coordinate exactly, or it is NaN or infinite.
[[nodiscard]] TREEFORM_API bool fits_single(std::span<const point3> points);

/// The ranks of a work that processes share, in a folder that all see. All call the same with
/// the same options; outputs are those of rank 0, and where one fails, `exchange` must throw.
struct communicator {
    std::size_t rank = 0;
    std::size_t size = 1;
    /// Collective: gives every rank what each has sent, in the order of the ranks.
    std::function<std::vector<std::string>(const std::string&)> exchange{};
};

}  // namespace treeform
