#pragma once
/// \file
/// Several files as one.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/export.hpp>

#include <span>
#include <string>
#include <vector>

namespace treeform {

/// The points and faces of `files` one after the other, as one file of the first one's format.
///
/// Columns of "vertex" and "face" go together by name; those that some files do not have are
/// filled up with NaN, 0 or empty lists there, and types widened until they hold every value.
/// Corners keep their texture coordinates and normals, and their texture files. Other elements are
/// left out (warning "left-out"). `names`, one a file, stand for the files in the warnings.
///
/// \throws std::invalid_argument when a column holds lists in one file and single values in
///         another, no type holds all values, or names are not one a file; std::length_error for
///         more points or triangles than 32-bit numbers can name
/// \cost   O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file join(std::vector<mesh_file> files,
                                          std::span<const std::string> names);

}  // namespace treeform
