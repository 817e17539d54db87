#pragma once
/// \file
/// Texture coordinates in a list property of the faces of a PLY.

#include <treeform/mesh/mesh_file.hpp>

#include <string_view>

namespace treeform::detail::io {

/// The usual name of the list, which has u and v of each corner.
inline constexpr std::string_view face_texture_name = "texcoord";

/// Moves the values of that list to `attributes::corners`; the column keeps its position, with
/// `column_role::texture`. Consecutive equal values at corners of a point become one row.
///
/// Changes nothing if a list is neither empty nor two numbers a corner, or if writing it again
/// would give other bytes.
void take_face_texture(mesh_file& file);

}  // namespace treeform::detail::io
