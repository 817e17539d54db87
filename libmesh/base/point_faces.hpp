#pragma once
/// \file
/// A point cloud as a mesh of degenerate faces.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::base {

/// [count] A face for each point, with this point as all three corners.
[[nodiscard]] inline std::vector<face> point_faces(std::size_t count) {
    std::vector<face> faces(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = static_cast<std::uint32_t>(i);
        faces[i] = {p, p, p};
    }
    return faces;
}

}  // namespace treeform::detail::base
