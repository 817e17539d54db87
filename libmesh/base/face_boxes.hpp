#pragma once
/// \file
/// The boxes of faces, for trees.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstdint>

namespace treeform::detail::base {

/// Returns the boxes of faces over `points`; an empty box, which builds report, if a coordinate is
/// not finite. \pre every corner is a point
template <class PointAt>
[[nodiscard]] auto face_boxes_of(const PointAt& point_at) {
    return [point_at](const face& f) {
        aabb<double, 3> box;
        double sum = 0.0;  // of zeros; NaN where a coordinate is NaN or infinite
        for (const std::uint32_t corner : f) {
            const point3 p = point_at(corner);
            box.include(p);
            sum += 0.0 * p.x + 0.0 * p.y + 0.0 * p.z;
        }
        return sum == 0.0 ? box : aabb<double, 3>{};
    };
}

[[nodiscard]] inline auto face_boxes(points_view points) {
    return face_boxes_of([points](std::uint32_t i) { return points[i]; });
}

/// The same for transformed points.
[[nodiscard]] inline auto face_boxes(points_view points, const transform<3>& move) {
    return face_boxes_of([points, move](std::uint32_t i) { return move(points[i]); });
}

}  // namespace treeform::detail::base
