#pragma once
/// \file
/// Colors of the materials of an OBJ.

#include <treeform/mesh/mesh_file.hpp>

#include <filesystem>

namespace treeform::detail::io {

/// Gives the faces of an OBJ, which is at `path`, the diffuse colors of their materials (`Kd`,
/// `d`), as columns red, green, blue, and alpha unless all is opaque. Faces without a material that
/// has a color are white. Nothing changes where no material file that the OBJ names is there, as
/// where `path` is empty, or none has a color of a material in use. What is no number in these
/// files is left out, for it says nothing of the mesh.
///
/// \throws nothing of its own
void add_material_colors(mesh_file& file, const std::filesystem::path& path);

}  // namespace treeform::detail::io
