#pragma once
/// \file
/// Reads the colors of the materials of an OBJ.

#include <treeform/mesh/mesh_file.hpp>

#include <filesystem>

namespace treeform::detail::io {

/// Gives the faces of the OBJ at `path` the diffuse colors of their materials (`Kd`, `d`), as
/// columns red, green, blue, and alpha unless all are opaque. Faces without a material with a color
/// are white. Changes nothing if no material file exists (as with an empty `path`), or none has a
/// color of a used material. Invalid numbers in these files are ignored.
///
/// \throws no io_error
void add_material_colors(mesh_file& file, const std::filesystem::path& path);

}  // namespace treeform::detail::io
