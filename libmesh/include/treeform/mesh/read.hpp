#pragma once
/// \file
/// Reading a mesh or point file, whatever its format.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace treeform {

/// Reads the file at `path`; "-" is standard input. `format` is an extension without its dot
/// ("stl", "obj", "ply", "off", "pcd", "xyz", "csv", "glb", ...); when empty the content decides,
/// then the extension.
///
/// Coordinates come back as stored: float32 widened, decimal text rounded once to the nearest
/// double. NaN and infinity are kept for the caller to report (`validate`).
///
/// `vt` and `vn` of an OBJ, and the list "texcoord" of the faces of a PLY where it has two numbers
/// a corner or none, are in `attributes::corners`; its lines `comment TextureFile NAME` are in
/// `attributes::texture_files`.
///
/// In text without a header a heading names the columns of numbers; columns x, y and z may then
/// stand anywhere. Of a PCD, a field of several values becomes columns "name[0]", "name[1]", ...,
/// and WIDTH, HEIGHT and VIEWPOINT of an organized cloud lines of `attributes::obj_info`: "num_cols
/// 640", "num_rows 480", "viewpoint 0 0 0 1 0 0 0".
///
/// \throws io_error naming path, line or byte, and reason
[[nodiscard]] TREEFORM_API mesh_file read(const std::filesystem::path& path,
                                          std::string_view format = {});

/// The same for bytes in memory; `name` stands for the path in errors.
[[nodiscard]] TREEFORM_API mesh_file read(std::span<const std::byte> bytes, std::string_view name,
                                          std::string_view format);

/// Whether scenes (GLB, 3MF, DAE, ...) are read: not by builds without assimp.
[[nodiscard]] TREEFORM_API bool reads_scenes();

}  // namespace treeform
