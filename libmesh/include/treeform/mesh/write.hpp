#pragma once
/// \file
/// Writing a mesh or point file.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace treeform {

struct write_options {
    /// Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, glb. Empty: that of the path.
    std::string format{};
    /// Text where the format has both. For PLY, binary is little endian unless the file was read
    /// from a big endian one; for PCD, it is compressed only when the file was read from one that
    /// is.
    bool ascii = false;
    /// Type of the coordinates; none: as they were stored. Binary STL and GLB hold float32 only.
    std::optional<treeform::precision> precision{};
};

struct write_result {
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    treeform::precision written_as = precision::float64;
    double largest_move = 0.0;  ///< largest change of a coordinate by rounding to `written_as`
    std::vector<io_warning> warnings{};
};

/// Writes `file` to `path`; "-" is standard output, which needs `options.format`.
///
/// A file appears whole or not at all: it is written beside its place and then renamed. Numbers in
/// text are the shortest that read back as the same double, also when that is a float32 value.
/// What the format can hold of `file.attributes` is written too: PLY takes all elements in their
/// order, and texture coordinates of corners as the list "texcoord" of faces, two numbers a corner,
/// in float32 unless the file has that list as double (NaN where a corner has none), and names of
/// texture files behind the comments; OFF normals, colors and texture coordinates of points; OBJ
/// parts, material files, texture coordinates and normals of corners, vertex colors; STL its
/// header, the names of solids and the column "stl_attribute", XYZ and CSV further columns, PCD
/// these and the lines "num_cols", "num_rows" and "viewpoint" of `obj_info`, GLB one primitive for
/// each color of faces (columns red, green, blue and alpha, if any, of the element "face"), and of
/// the other columns of faces those of whole numbers from 0 on, as accessors that the primitive's
/// `extras.face_properties` names. Polygons are written as such where the format has them, and
/// names with blanks for newlines. Values of corners, materials and names of texture files that the
/// format does not hold are warned of.
///
/// A mesh without points and faces can be written in every format of meshes, and read again.
///
/// \throws io_error when the format cannot hold the file or the file cannot be written
/// \throws std::invalid_argument when a corner is no point, or an element "vertex" or "face" has
///         another number of rows than there are points or stored faces, or a number of a corner
///         in `attributes::corners` is none of a row
/// \same   bytes for the same file and options
TREEFORM_API write_result write_mesh(const std::filesystem::path& path, const mesh_file& file,
                                     const write_options& options = {});

/// The same to memory.
[[nodiscard]] TREEFORM_API std::string write_mesh_to_memory(const mesh_file& file,
                                                            const write_options& options);

}  // namespace treeform
