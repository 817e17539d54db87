#pragma once
/// \file
/// Writing a mesh or point file.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>

#include <concepts>
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
    /// Whether coordinates that were certified may be rounded further, which can undo what the
    /// certificate says. Those of anything else are rounded where the type asks for it.
    bool round = false;
};

struct write_result {
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    treeform::precision written_as = precision::float64;
    /// Largest change of a coordinate by rounding to `written_as`.
    double max_displacement = 0.0;
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
/// \throws std::invalid_argument when a corner is out of range, or an element "vertex" or "face"
///         has another number of rows than there are points or stored faces, or a number of a
///         corner in `attributes::corners` is none of a row
/// \same   bytes for the same file and options
TREEFORM_API write_result write(const std::filesystem::path& path, const mesh_file& file,
                                const write_options& options = {});

/// The same of a mesh that came from no file.
TREEFORM_API write_result write(const std::filesystem::path& path, mesh surface,
                                const write_options& options = {});

/// What verbs return that certify coordinates.
template <class Result>
concept certified_result = requires(const Result& result) {
    { result.value() } -> std::convertible_to<const mesh&>;
    { result.certificate } -> std::convertible_to<const certificate&>;
};

namespace detail::io {
TREEFORM_API write_result write_certified(const std::filesystem::path& path, mesh surface,
                                          const write_options& options);
}

/// The mesh of a result, in the coordinates that were certified: binary STL and GLB hold those of
/// `precision::float32` only.
///
/// \throws not_certified_error unless the certificate's status is ok
/// \throws io_error as above, and when a coordinate would be rounded and `options.round` is not set
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
