#pragma once
/// \file
/// A cloud of points as a mesh whose faces are points.

#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform {

/// A face for each of `count` points, of that corner alone: with them a cloud is related, measured,
/// slid, settled and cleared as a mesh is, and face numbers are those of the points.
///
/// A cloud bounds nothing: it penetrates a mesh when a point lies strictly inside of the solid that
/// the mesh bounds, and touches it when one is on a face.
[[nodiscard]] inline std::vector<face> point_faces(std::size_t count) {
    std::vector<face> faces(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = static_cast<std::uint32_t>(i);
        faces[i] = {p, p, p};
    }
    return faces;
}

}  // namespace treeform
