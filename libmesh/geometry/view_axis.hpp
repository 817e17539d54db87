#pragma once
/// \file
/// Projection of a triangle along a coordinate axis without degeneration.

#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::detail::geometry {

struct view_axis {
    int axis = 0;  ///< 0, 1 or 2: the coordinate that is dropped
    int turn = 0;  ///< sign of orient2d of the projected corners: +1 or -1
};

/// An axis that is not parallel to the plane of `t`; empty if `t` is degenerate. Projection along
/// any such axis preserves the orientation of points in the plane up to a common sign. Of several,
/// the one closest to the normal, up to rounding, is returned, since predicates are fastest there.
[[nodiscard]] std::optional<view_axis> find_view_axis(const triangle3& t,
                                                      predicate_counters* counters);

/// The feature of a triangle that contains a point of its plane, from the signs of the point's
/// orientations relative to the three edges, which are not all zero. Empty if the point is outside:
/// if and only if two of the signs are opposite.
[[nodiscard]] constexpr std::optional<triangle_feature> locate(const std::array<int, 3>& about) {
    const bool left = about[0] > 0 || about[1] > 0 || about[2] > 0;
    const bool right = about[0] < 0 || about[1] < 0 || about[2] < 0;
    if (left && right) return std::nullopt;
    if (about[0] == 0) {
        if (about[1] == 0) return triangle_feature::v1;
        return about[2] == 0 ? triangle_feature::v0 : triangle_feature::e0;
    }
    if (about[1] == 0) return about[2] == 0 ? triangle_feature::v2 : triangle_feature::e1;
    return about[2] == 0 ? triangle_feature::e2 : triangle_feature::interior;
}

}  // namespace treeform::detail::geometry
