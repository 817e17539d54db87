#pragma once
/// \file
/// Where a triangle meets the plane of another, by the signs of its corners alone.

#include <libmesh/geometry/features.hpp>

#include <array>

namespace treeform::detail::geometry {

/// An end of the segment that a plane cuts from a triangle: the point where the triangle's side
/// from corner `below` to corner `above` meets the plane. One of the two may lie on the plane, and
/// is the end itself then.
struct interval_end {
    int below = 0;
    int above = 0;
    feature name = feature::interior;
};

/// The common segment of a triangle and a plane that it meets without lying in it. Seen along the
/// triangle's normal with the plane's normal pointing up, `west` is its left end and `east` its
/// right one; both are the same corner where that is all that meets.
struct plane_interval {
    interval_end west;
    interval_end east;
    feature inside = feature::interior;  ///< name of the points between the ends
};

constexpr interval_end end_at_corner(const std::array<int, 3>& side, int i) {
    const int partner = side[static_cast<std::size_t>(next(i))] != 0 ? next(i) : previous(i);
    const bool rises = side[static_cast<std::size_t>(partner)] > 0;
    return {rises ? i : partner, rises ? partner : i, corner(i)};
}

/// The boundary runs counter-clockwise, so where it comes down through the plane the triangle lies
/// to the east of it: that is the west end. A corner on the plane is passed on the way down when
/// the corner before it is no lower than the one after, and on the way up when it is no higher.
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

/// All 27 patterns of signs, by `side_key`; those without a common segment are never read.
inline constexpr std::array<plane_interval, 27> plane_intervals = [] {
    std::array<plane_interval, 27> table{};
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                table[side_key({x, y, z})] = make_plane_interval({x, y, z});
    return table;
}();

}  // namespace treeform::detail::geometry
