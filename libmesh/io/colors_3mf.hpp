#pragma once
/// \file
/// Colors and texture coordinates of the triangles of a 3MF build.

#include <libmesh/io/model_3mf.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <vector>

namespace treeform::detail::io {

/// [triangles of the build]; shorter or empty if the remaining ones have none.
struct looks_3mf {
    std::vector<face> colors{};  ///< palette entries of corners
    /// texture coordinates of corners, as numbers of those of the model
    std::vector<face> texture{};
};

/// Appends the values of an object whose first triangle is `first_face`. `turned`: the second and
/// third corner of each triangle were swapped.
void append_looks(looks_3mf& to, std::size_t first_face, const object_3mf& object, bool turned);

/// Sets the colors of the file: of faces if each has a single color; of points if each point has a
/// single color; else of faces, by their first corners, with a warning. Also sets the texture
/// coordinates of corners.
void add_looks(const model_3mf& model, looks_3mf&& looks, mesh_file& file);

}  // namespace treeform::detail::io
