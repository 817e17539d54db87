#pragma once
/// \file
/// A cloud of points as a mesh whose faces are points.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::base {

/// A face for each of `count` points, of that corner alone.
[[nodiscard]] inline std::vector<face> point_faces(std::size_t count) {
    std::vector<face> faces(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = static_cast<std::uint32_t>(i);
        faces[i] = {p, p, p};
    }
    return faces;
}

}  // namespace treeform::detail::base
