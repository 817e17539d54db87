#pragma once
/// \file
/// The boxes of faces, as trees want them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

namespace treeform::bench {

/// Makes the box of a face of `mesh`, in double.
/// \pre `mesh` outlives the result
[[nodiscard]] inline auto face_box(const mesh& mesh) {
    return [points = points_view(mesh.points)](const face& f) {
        aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(points[corner]);
        return box;
    };
}

}  // namespace treeform::bench
