#pragma once
/// \file
/// Normals of a file whose points are moved.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/transform.hpp>

namespace tools {

/// Turns the columns nx, ny, nz of the file's elements, and the normals of corners, as `matrix`
/// turns normals; their lengths stay.
void turn_normals(tf::mesh_file& file, const tf::transform<3>& matrix);

}  // namespace tools
