#pragma once
/// \file
/// Texture coordinates that a PLY has in a list of each face.

#include <treeform/mesh/mesh_file.hpp>

#include <string_view>

namespace treeform::detail::io {

/// What programs call the list: u and v of each corner in turn.
inline constexpr std::string_view face_texture_name = "texcoord";

/// Moves the values of that list to `attributes::corners`; the column stays where it is, with
/// `column_role::texture`. Equal values of a point's corners that follow each other become one row.
///
/// Where a list is neither empty nor two numbers a corner, or where writing it again would give
/// other bytes, all stays as it is.
void take_face_texture(mesh_file& file);

}  // namespace treeform::detail::io
