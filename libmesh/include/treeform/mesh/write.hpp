#pragma once
/// \file
/// Writes a mesh or point file.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

/// How to write.
struct write_options {
    /// Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, las, laz, glb, 3mf. Empty: the
    /// extension of the path.
    std::string format{};
    /// Write text if the format has text and binary. Binary PLY is little endian, unless the file
    /// was read from a big-endian file. PCD is compressed only if it was read from a compressed
    /// file.
    bool ascii = false;
    /// Precision of the coordinates; none: the stored precision, but float32 in 3MF, since most of
    /// its readers convert to float. Binary STL and GLB only hold float32.
    std::optional<treeform::precision> precision{};
    /// Keep names and types of columns of points as in `file`, even if the format has its own.
    bool keep_names = false;
    /// Columns of points to omit; "normal", "uv" or "color" for all columns of that kind, also of
    /// corners.
    std::vector<std::string> drop{};
    /// Renamed columns of points, as pairs (new name, present name).
    std::vector<std::pair<std::string, std::string>> rename{};
    /// For LAS and LAZ: coordinates are multiples of this, plus the offset. By default those of the
    /// file that was read, else chosen by `write`.
    std::optional<std::array<double, 3>> las_scale{};
    std::optional<std::array<double, 3>> las_offset{};
    /// Allow rounding of certified coordinates, which may invalidate the certificate. Coordinates
    /// without a certificate are always rounded to the precision.
    bool round = false;
    /// Called with numbers below 1 while writing, and with 1 before the file is renamed. If it
    /// returns false, nothing is written, and an existing file is unchanged.
    progress_callback progress{};
};

/// The result of `write`.
struct write_result {
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    treeform::precision written_as = precision::float64;
    /// Largest change of a coordinate by rounding to `written_as`.
    double max_displacement = 0.0;
    std::vector<io_warning> warnings{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing was written
};

/// Writes `file` to `path`; "-" is standard output, which needs `options.format`.
///
/// A file is written completely or not at all: it is written under another name and then renamed.
/// Numbers in text are the shortest that read back as the same double, float32 values included.
/// Polygons are written as polygons if the format has polygons. Newlines in names become blanks.
///
/// Each format stores what it can of `file.attributes`:
/// - PLY: all elements in their order; texture coordinates of corners, as the list "texcoord" of
///   faces with two numbers a corner, in float32 unless the file has that list as double (NaN where
///   a corner has none); names of texture files, after the comments.
/// - OBJ: parts, material files, texture coordinates and normals of corners (else those of points),
///   colors of vertices.
/// - OFF: normals, colors and texture coordinates of points.
/// - STL: the header, without a leading "solid"; if it has no NUL byte, its last byte becomes NUL;
///   the names of solids; the column "stl_attribute".
/// - XYZ and CSV: the other columns of points. PCD: also the lines "num_cols", "num_rows" and
///   "viewpoint" of `obj_info`.
/// - LAS and LAZ: the dimensions listed at `las_header`; other columns as extra bytes. Columns red,
///   green and blue of 8 bits are multiplied by 256. Without columns for them, return_number and
///   number_of_returns are 1. Intensities that are not integers are rounded, or multiplied by 65535
///   if all are from 0 to 1. scan_angle_rank becomes scan_angle in point formats 6 to 10.
///   Coordinates that are not multiples of the file's scale are rounded (`max_displacement`). A
///   file that was not LAS gets the smallest format that holds its columns, and for each axis the
///   coarsest scale of 1, 0.1, 0.01, ... that gives all coordinates back within two units in their
///   last place, else the finest that 32 bits allow.
/// - GLB: one node and mesh for each run of faces of the same object and group, with its name and
///   the points that it uses. Each mesh has one primitive, with a material, for each color of its
///   faces (columns red, green, blue and, if present, alpha of the element "face"). Other columns
///   of faces with nonnegative integers become accessors, listed in the primitive's
///   `extras.face_properties`. Of the columns of points, red, green, blue and alpha become COLOR_0
///   (8 and 16 bits unchanged, other types as floats from 0 to 1); nx, ny and nz become NORMAL,
///   scaled to length 1; s and t, u and v, or texture_u and texture_v become TEXCOORD_0 (u = s, v =
///   1-t). Normals and texture coordinates of corners take precedence over those of points; a point
///   with several of them is repeated.
/// - 3MF: one object and one item of the build for each part (`file_parts`), with its name;
///   materials of parts with the colors of their faces; else colors of faces, else of points; the
///   unit in the line "unit ..." of `obj_info`, else millimeters. Polygons are written as
///   triangles. Numbers are written as the shortest text of the double, so that readers of floats
///   and of doubles get the same value.
///
/// Columns of points that several formats have get the name and type of the written format: colors
/// are red, green and blue of 8 bits, but in LAS of 16, in PCD the packed `rgb`, in OBJ numbers
/// from 0 to 1; normals are nx, ny, nz, in PCD normal_x, ..., in OBJ `vn`. If a file was read from
/// the format that is written, its columns are unchanged.
///
/// `write_result::warnings` lists what is scaled, rounded or omitted.
///
/// An empty mesh can be written in every mesh format, and read again.
///
/// \throws io_error if the format cannot hold the file, or the file cannot be written
/// \throws std::invalid_argument for a corner out of range; unless the elements "vertex" and "face"
///         have one row for each point and stored face; for an index in `attributes::corners` out
///         of range
/// \same   bytes for the same file and options
TREEFORM_API write_result write(const std::filesystem::path& path, const mesh_file& file,
                                const write_options& options = {});

/// Rounds the coordinates of `file` as `write` does for a LAS file, and sets the scale and offset
/// in `mesh_file::las`, so that later decisions about the points hold for the written file. Returns
/// the largest change of a coordinate: 0 for an unchanged LAS file. Coordinates that are not finite
/// are not changed. Only scale and offset of `options` are used.
///
/// \throws io_error naming the first point that does not fit into 32 bits with the file's scale
/// \cost   O(V)
TREEFORM_API double round_to_las(mesh_file& file, const write_options& options = {});

/// `write` for a mesh without attributes.
TREEFORM_API write_result write(const std::filesystem::path& path, mesh surface,
                                const write_options& options = {});

/// A result with a mesh or a file, such as `boolean_result`, `weld_result` and `repaired_file`.
template <class Result>
concept mesh_result = requires(const Result& result) {
    { result.mesh } -> std::convertible_to<const mesh&>;
}
|| requires(const Result& result) {
    { result.file } -> std::convertible_to<const mesh_file&>;
};

namespace detail::io {
TREEFORM_API write_result write_certified(const std::filesystem::path& path, mesh surface,
                                          const write_options& options);
TREEFORM_API write_result write_certified(const std::filesystem::path& path, const mesh_file& file,
                                          const write_options& options);
}  // namespace detail::io

/// Writes the mesh or the file of a result, with its attributes if it has any; if it has a
/// certificate, in the certified coordinates. Binary STL and GLB only hold `precision::float32`.
///
/// \throws not_certified_error unless the certificate's status is ok
/// \throws io_error as for a file; if a coordinate would be rounded and `options.round` is not set
template <mesh_result Result>
write_result write(const std::filesystem::path& path, const Result& result,
                   const write_options& options = {}) {
    if constexpr (requires { result.certificate; }) {
        return options.round ? write(path, result.value(), options)
                             : detail::io::write_certified(path, result.value(), options);
    } else if constexpr (requires { result.file; }) {
        return write(path, result.file, options);
    } else if constexpr (requires { result.attributes; }) {
        mesh_file file;
        file.mesh = result.mesh;
        file.attributes = result.attributes;
        return write(path, file, options);
    } else {
        return write(path, result.mesh, options);
    }
}

/// The bytes that `write` writes.
[[nodiscard]] TREEFORM_API std::string write_to_memory(const mesh_file& file,
                                                       const write_options& options);

}  // namespace treeform
