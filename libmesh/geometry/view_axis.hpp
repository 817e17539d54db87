#pragma once
/// \file
/// Along which axis a triangle can be looked at without losing a dimension.

#include <treeform/mesh/predicates.hpp>

#include <optional>

namespace treeform::detail::geometry {

struct view_axis {
    int axis = 0;  ///< 0, 1 or 2: the coordinate left out
    int turn = 0;  ///< orient2d of the triangle's corners along it: +1 or -1
};

/// An axis to which the plane of `t` is not parallel, or nothing when `t` is degenerate. Any such
/// axis keeps the order of points in the plane; of several, the one is taken that the plane faces
/// most, up to rounding, since predicates decide fastest there.
[[nodiscard]] std::optional<view_axis> find_view_axis(const triangle3& t,
                                                      predicate_counters* counters);

/// Where a point lies in a triangle, from the signs of its orientation about the three edges,
/// which are taken in one plane and not all zero. Nothing when it lies outside: then, and only
/// then, two of the signs are opposite.
[[nodiscard]] constexpr std::optional<feature> locate(const std::array<int, 3>& about) {
    const bool left = about[0] > 0 || about[1] > 0 || about[2] > 0;
    const bool right = about[0] < 0 || about[1] < 0 || about[2] < 0;
    if (left && right) return std::nullopt;
    if (about[0] == 0) {
        if (about[1] == 0) return feature::v1;
        return about[2] == 0 ? feature::v0 : feature::e0;
    }
    if (about[1] == 0) return about[2] == 0 ? feature::v2 : feature::e1;
    return about[2] == 0 ? feature::e2 : feature::interior;
}

}  // namespace treeform::detail::geometry
