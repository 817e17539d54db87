#pragma once
/// \file
/// Colors and texture coordinates of the triangles of a 3MF build.

#include <libmesh/io/model_3mf.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::io {

/// By triangles of the build; shorter than it, or empty, where the rest has none.
struct looks_3mf {
    std::vector<face> colors{};   ///< of corners, in the palette
    std::vector<face> texture{};  ///< of corners, in the texture coordinates of the model
};

/// Appends those of an object whose triangles come from number `first_face` on. `turned` says that
/// the second and the third corner of each have changed places.
void append_looks(looks_3mf& to, std::size_t first_face, const object_3mf& object, bool turned);

/// Gives the file its colors: to the faces when each has one; to the points when each point has
/// one; else to the faces, that of their first corners, with a warning. Also the texture
/// coordinates of corners.
void add_looks(const model_3mf& model, looks_3mf&& looks, mesh_file& file);

}  // namespace treeform::detail::io
