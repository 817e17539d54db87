#pragma once
/// \file
/// The smallest axis-parallel box around points.

#include <treeform/mesh/points.hpp>
#include <treeform/tree/export.hpp>

#include <optional>

namespace treeform {

struct box3 {
    point3 min;
    point3 max;
    friend bool operator==(const box3&, const box3&) = default;
};

/// The box of the points whose coordinates are all finite; none when there is no such point.
///
/// \cost O(V) time
/// \same on any number of threads
[[nodiscard]] TREEFORM_API std::optional<box3> bounding_box(points_view points);

/// Length of the diagonal, rounded; the largest double where it would be infinite.
[[nodiscard]] TREEFORM_API double diagonal(const box3& box);

}  // namespace treeform
