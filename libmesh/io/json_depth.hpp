#pragma once
/// \file
/// A look at JSON before a recursive parser gets it.

#include <libmesh/io/source.hpp>

namespace treeform::detail::io {

/// Refuses glTF, in text or binary, whose JSON, or whose nodes, nest so deeply that loading would
/// exhaust the stack, or whose binary JSON is cut short. JSON that is wrong otherwise is left to
/// the parser.
///
/// \throws io_error naming the byte, or the node
void refuse_deep_json(const source& gltf);

}  // namespace treeform::detail::io
