#pragma once
/// \file
/// A degenerate triangle as the segment or point that it is.

#include <treeform/mesh/predicates.hpp>

#include <array>
#include <optional>

namespace treeform::detail::geometry {

/// A closed segment and the names of its points: `inside` are those between the ends. A segment
/// whose ends are equal is a point, named as its ends are.
struct named_segment {
    point3 from;
    point3 to;
    feature from_name;
    feature to_name;
    feature inside;
};

/// A degenerate triangle cut at the corner between the other two, if there is one: each part
/// lies on the same edges throughout, so its inner points have one name.
struct flat_triangle {
    std::array<named_segment, 2> parts;
    int part_count = 1;
    bool is_point = false;

    [[nodiscard]] point3 from() const { return parts[0].from; }
    [[nodiscard]] point3 to() const { return last().to; }
    [[nodiscard]] bool ends_at(feature f) const {
        return f == parts[0].from_name || f == last().to_name;
    }
    [[nodiscard]] bool is_cut_at(feature f) const {
        return part_count == 2 && f == parts[0].to_name;
    }

  private:
    [[nodiscard]] const named_segment& last() const {
        return parts[static_cast<std::size_t>(part_count - 1)];
    }
};

/// `t` from its lexicographically least corner to its greatest; along a line that order is the
/// line's. Points have the lowest-numbered name that fits: equal corners that of the first.
/// \pre the corners are collinear
[[nodiscard]] flat_triangle flatten(const triangle3& t);

/// Order by x, then y, then z; on one line, from one end to the other. Right even where a processor
/// flushes denormals to zero.
[[nodiscard]] bool lexicographically_less(const point3& p, const point3& q);

}  // namespace treeform::detail::geometry
