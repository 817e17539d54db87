#pragma once
/// \file
/// Several files as one set.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <string>
#include <vector>

namespace tools {

/// The points and faces of `files` one after the other, as one file of the first one's format.
///
/// Columns of "vertex" and "face" go together by name; those that some files do not have are
/// filled up with NaN, 0 or empty lists there, and types widened until they hold every value.
/// Corners keep their texture coordinates and normals, and their texture files. Other elements are
/// left out. `names` stand for the files in the warnings about all this.
///
/// \throws failure (bad_input) when a column holds lists in one file and single values in another,
///         or no type holds all values; or for more points or triangles than 32-bit numbers can
///         name
[[nodiscard]] tf::mesh_file join_files(std::vector<tf::mesh_file> files,
                                       const std::vector<std::string>& names);

}  // namespace tools
