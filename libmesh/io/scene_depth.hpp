#pragma once
/// \file
/// Checks the nesting depth of XML, FBX and DirectX scenes before a recursive loader reads them.

#include <libmesh/io/source.hpp>

namespace treeform::detail::io {

/// Refuses XML (DAE, AMF and others), FBX in text or binary, and DirectX in text that nest more
/// than a thousand levels deep, detected by content: the loaders are recursive, and would exhaust
/// the stack. Other errors are left to the loaders.
///
/// \throws io_error
/// \cost   O(size) time; none for other formats
void refuse_deep_scene(const source& scene);

}  // namespace treeform::detail::io
