#pragma once
/// \file
/// Converts the build of a 3MF package to one mesh.

#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh_file.hpp>

namespace treeform::detail::io {

/// The objects of all items, transformed, each as a part of its own. Sizes are counted before
/// anything is built.
///
/// \throws io_error for an object that is its own component, and for too many objects, points or
///         faces
[[nodiscard]] mesh_file place_3mf(const source& in, const model_3mf& model);

}  // namespace treeform::detail::io
