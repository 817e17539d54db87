#pragma once
/// \file
/// A degenerate triangle as a segment or point.

#include <treeform/mesh/predicates.hpp>

#include <array>
#include <optional>

namespace treeform::detail::geometry {

/// A closed segment and the features of its points; `inside` is the feature of the points between
/// the ends. A segment with equal ends is a point with the feature of its ends.
struct named_segment {
    point3 from;
    point3 to;
    triangle_feature from_name;
    triangle_feature to_name;
    triangle_feature inside;
};

/// A degenerate triangle, split at the corner between the other two, if there is one: each part is
/// on the same edges throughout, so its inner points have one feature.
struct flat_triangle {
    std::array<named_segment, 2> parts;
    int part_count = 1;
    bool is_point = false;

    [[nodiscard]] point3 from() const { return parts[0].from; }
    [[nodiscard]] point3 to() const { return last().to; }
    [[nodiscard]] bool ends_at(triangle_feature f) const {
        return f == parts[0].from_name || f == last().to_name;
    }
    [[nodiscard]] bool is_cut_at(triangle_feature f) const {
        return part_count == 2 && f == parts[0].to_name;
    }

  private:
    [[nodiscard]] const named_segment& last() const {
        return parts[static_cast<std::size_t>(part_count - 1)];
    }
};

/// `t` from its lexicographically least corner to its greatest; for points on a line, that is the
/// order along the line. Points have the lowest-numbered feature that applies: equal corners have
/// that of the first.
/// \pre the corners are collinear
[[nodiscard]] flat_triangle flatten(const triangle3& t);

/// Order by x, then y, then z; on a line, the order along it. Correct even on a processor that
/// flushes denormals to zero.
[[nodiscard]] bool lexicographically_less(const point3& p, const point3& q);

}  // namespace treeform::detail::geometry
