#pragma once
/// \file
/// The build of a 3MF package as one mesh.

#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::io {

/// The objects of all items, where their transforms put them, each a part of its own. What they
/// amount to is counted before anything is built.
///
/// \throws io_error for an object that is its own component, and for more objects, points or faces
///         than a mesh may have
[[nodiscard]] mesh_file place_3mf(const source& in, const model_3mf& model);

}  // namespace treeform::detail::io
