#pragma once
/// \file
/// The intersection of a triangle with the plane of another, from the signs of its corners only.

#include <libmesh/geometry/features.hpp>

#include <array>

namespace treeform::detail::geometry {

/// An end of the intersection of a triangle with a plane: the point where the side from corner
/// `below` to corner `above` meets the plane. If one of the two corners is on the plane, it is the
/// end.
struct interval_end {
    int below = 0;
    int above = 0;
    triangle_feature name = triangle_feature::interior;
};

/// The common segment of a triangle and a plane that meets but does not contain it. Seen along the
/// triangle's normal with the plane's normal pointing up, `west` is the left end and `east` the
/// right end; both are the same corner if only that corner is on the plane.
struct plane_interval {
    interval_end west;
    interval_end east;
    triangle_feature inside =
        triangle_feature::interior;  ///< feature of the points between the ends
};

constexpr interval_end end_at_corner(const std::array<int, 3>& side, int i) {
    const int partner = side[static_cast<std::size_t>(next(i))] != 0 ? next(i) : previous(i);
    const bool rises = side[static_cast<std::size_t>(partner)] > 0;
    return {rises ? i : partner, rises ? partner : i, corner(i)};
}

/// The boundary is counter-clockwise, so where it passes down through the plane, the triangle is to
/// the east: that is the west end. A corner on the plane is passed downward if the previous corner
/// is not lower than the next one, and upward if it is not higher.
constexpr plane_interval make_plane_interval(const std::array<int, 3>& side) {
    plane_interval result;
    for (int i = 0; i < 3; ++i) {
        const int here = side[static_cast<std::size_t>(i)];
        const int after = side[static_cast<std::size_t>(next(i))];
        const int before = side[static_cast<std::size_t>(previous(i))];
        if (here == 0) {
            if (before >= after) result.west = end_at_corner(side, i);
            if (before <= after) result.east = end_at_corner(side, i);
            if (after == 0) result.inside = edge(i);
        } else if (here > 0 && after < 0) {
            result.west = {next(i), i, edge(i)};
        } else if (here < 0 && after > 0) {
            result.east = {i, next(i), edge(i)};
        }
    }
    return result;
}

constexpr std::size_t side_key(const std::array<int, 3>& side) {
    const int key = side[0] + 1 + 3 * (side[1] + 1) + 9 * (side[2] + 1);
    return static_cast<std::size_t>(key);
}

/// All 27 patterns of signs, by `side_key`. Entries without a common segment are not used.
inline constexpr std::array<plane_interval, 27> plane_intervals = [] {
    std::array<plane_interval, 27> table{};
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                table[side_key({x, y, z})] = make_plane_interval({x, y, z});
    return table;
}();

}  // namespace treeform::detail::geometry
