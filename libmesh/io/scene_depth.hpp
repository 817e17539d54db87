#pragma once
/// \file
/// A look at scenes of XML, FBX and DirectX before a recursive loader gets them.

#include <libmesh/io/source.hpp>

namespace treeform::detail::io {

/// Refuses XML (DAE, AMF and others), FBX in text or binary, and DirectX in text that nest
/// more than a thousand levels deep, by what they hold, whatever their name: the loaders recurse,
/// and the stack would be exhausted. What is wrong otherwise is left to them.
///
/// \throws io_error
/// \cost   O(size) time; none for other formats
void refuse_deep_scene(const source& scene);

}  // namespace treeform::detail::io
