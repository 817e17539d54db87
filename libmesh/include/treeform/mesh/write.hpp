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
    /// Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, las, laz, glb, 3mf. Empty:
    /// that of the path.
    std::string format{};
    /// Write text if the format has text and binary. Binary PLY is little endian, unless the file
    /// was read from a big-endian file. PCD is compressed only if it was read from a compressed
    /// file.
    bool ascii = false;
    /// Precision of the coordinates; none: as they were stored. Binary STL and GLB only hold
    /// float32. 3MF holds doubles, but most of its readers convert to float, so none means float32
    /// there.
    std::optional<treeform::precision> precision{};
    /// Keep names and types of columns of points as in `file`, even if the format has its own.
    bool keep_names = false;
    /// Columns of points to omit; "normal", "uv" or "color" for all columns of that kind, also of
    /// corners.
    std::vector<std::string> drop{};
    /// Of points: new names for columns, each with the one that the column has.
    std::vector<std::pair<std::string, std::string>> rename{};
    /// For LAS and LAZ; none: those of the file, else chosen by `write`.
    std::optional<std::array<double, 3>> las_scale{};
    std::optional<std::array<double, 3>> las_offset{};
    /// Allow rounding of certified coordinates, which may invalidate the certificate. Coordinates
    /// without a certificate are always rounded to the precision.
    bool round = false;
    /// Called with 0 at the start and during the writing, and with 1 before the file is renamed. If
    /// it returns false, nothing is written, and an existing file is unchanged.
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
/// Of `file.attributes`, each format takes what it can hold:
/// - PLY: all elements in their order; texture coordinates of corners, as the list "texcoord" of
///   faces with two numbers a corner, in float32 unless the file has that list as double (NaN where
///   a corner has none); names of texture files, behind the comments.
/// - OBJ: parts, material files, texture coordinates and normals of corners, or those of points,
///   vertex colors.
/// - OFF: normals, colors and texture coordinates of points.
/// - STL: its header, without a leading "solid" and with a NUL as its last byte where it has none;
///   the names of solids, the column "stl_attribute".
/// - XYZ and CSV: further columns. PCD: these, and the lines "num_cols", "num_rows" and "viewpoint"
///   of `obj_info`.
/// - LAS and LAZ: what `las_header` says; further columns as extra bytes. Columns red, green and
///   blue of 8 bits are multiplied by 256; points that no column says it of are returns 1 of 1;
///   intensities that are no whole numbers are rounded, or multiplied by 65535 where all are from 0
///   to 1; scan_angle_rank becomes scan_angle in formats from 6 on. Coordinates that the file's
///   scale and offset do not hold are rounded (`max_displacement`). A file that was not LAS gets
///   the smallest format that holds its columns, and for each axis the coarsest scale of 1, 0.1,
///   0.01, ... that gives all coordinates back within two units in their last place, else the
///   finest that 32 bits allow.
/// - GLB: a node and a mesh with the points that they use for faces of one object and group in a
///   row, with their name; in these, one primitive for each color of faces (columns red, green,
///   blue and alpha, if any, of the element "face"), which materials have. Other columns of faces
///   with whole numbers from 0 on become accessors that the primitive's `extras.face_properties`
///   names. Columns of points: red, green, blue and alpha become COLOR_0, of 8 and 16 bits as they
///   are, others as floats from 0 to 1; nx, ny and nz NORMAL, with length 1; s and t, u and v or
///   texture_u and texture_v TEXCOORD_0, with v = 1 - t. Those of corners go ahead of these, and a
///   point gets a copy for each that it has.
/// - 3MF: an object and an item of the build for each part, as `split_parts` has them, with its
///   name; materials of parts with the colors of their faces; else colors of faces, else of points;
///   the line "unit ..." of `obj_info`, else millimeters. Polygons are written as triangles. A
///   number in text is that of the double, so that readers of floats and of doubles get the same.
///
/// Columns of points that several formats know have the names and types of the format that is
/// written (`libmesh/attributes/known_columns.cpp` is the table): colors are red, green and blue of
/// 8 bits, but in LAS of 16, in PCD the packed `rgb`, in OBJ numbers from 0 to 1; normals are nx,
/// ny, nz, in PCD normal_x, ..., in OBJ `vn`. A file is not translated to its own format.
///
/// Warnings tell what is scaled, rounded or omitted.
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

/// Rounds the coordinates of `file` to those of a LAS file, and sets the scale and offset of that
/// file (`mesh_file::las`), so that later decisions about the points hold for the written file.
/// Returns the largest change of a coordinate: 0 for an unchanged LAS file. Coordinates that are
/// not finite stay. Only scale and offset of `options` are used.
///
/// \throws io_error naming the first point that does not fit into 32 bits with the file's scale
/// \cost   O(V)
TREEFORM_API double round_to_las(mesh_file& file, const write_options& options = {});

/// `write` for a mesh without attributes.
TREEFORM_API write_result write(const std::filesystem::path& path, mesh surface,
                                const write_options& options = {});

/// A result with a certificate, such as `boolean_result` and `repair_result`.
template <class Result>
concept certified_result = requires(const Result& result) {
    { result.value() } -> std::convertible_to<const mesh&>;
    { result.certificate } -> std::convertible_to<const certificate&>;
};

namespace detail::io {
TREEFORM_API write_result write_certified(const std::filesystem::path& path, mesh surface,
                                          const write_options& options);
TREEFORM_API write_result write_certified(const std::filesystem::path& path, const mesh_file& file,
                                          const write_options& options);
}  // namespace detail::io

/// Writes the mesh of a result in the certified coordinates. Binary STL and GLB only hold
/// `precision::float32`.
///
/// \throws not_certified_error unless the certificate's status is ok
/// \throws io_error as above; if a coordinate would be rounded and `options.round` is not set
template <certified_result Result>
write_result write(const std::filesystem::path& path, const Result& result,
                   const write_options& options = {}) {
    return options.round ? write(path, result.value(), options)
                         : detail::io::write_certified(path, result.value(), options);
}

/// The bytes of the file.
[[nodiscard]] TREEFORM_API std::string write_to_memory(const mesh_file& file,
                                                       const write_options& options);

}  // namespace treeform
