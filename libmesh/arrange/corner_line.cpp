#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/exact/box_around.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace treeform::detail::arrange {

corner_line::corner_line(const std::array<implicit_point, 3>& corners, int along)
    : corners_(corners),
      along_(along),
      faces_(orient2d(along, corners[0], corners[1], corners[2])),
      start_(exact::box_around(corners[0])) {
    assert(faces_ != 0);
    is_given_ =
        std::ranges::all_of(corners, [](const implicit_point& p) { return p.radius() == 0.0; });
    if (is_given_) given_ = {corners[0].center(), corners[1].center(), corners[2].center()};
}

// Which side of an edge the line is on is affine in the place of the line: 0 at a, it is s times
// what it is at b, and 0 there, too, s^2 times what it is at c. Likewise how far ahead a plane is
// of the face, which the corners are on.

template <class Point>
int corner_line::passes(const std::array<Point, 3>& t, const std::array<Point, 3>& corners) const {
    const auto about = [&](const Point& p, const Point& r) {
        for (const Point& corner : corners)
            if (const int sign = orient2d(along_, p, r, corner); sign != 0) return sign;
        return 0;
    };
    const int sign = about(t[0], t[1]);
    return sign != 0 && about(t[1], t[2]) == sign && about(t[2], t[0]) == sign ? sign : 0;
}

int corner_line::passes(const triangle3& t) const {
    for (const int turn : {1, 2}) {
        const auto k = static_cast<std::size_t>((along_ + turn) % 3);
        const auto [low, high] = std::minmax({t[0][k], t[1][k], t[2][k]});
        if (high < start_.min[k] || low > start_.max[k]) return 0;
    }
    if (is_given_) return passes<point3>({t[0], t[1], t[2]}, {given_[0], given_[1], given_[2]});
    return passes<implicit_point>({t[0], t[1], t[2]}, corners_);
}

int corner_line::place(const triangle3& t, int facing) const {
    for (const implicit_point& corner : corners_)
        if (const int on = side({t[0], t[1], t[2]}, corner); on != 0) return -on * facing;
    return 0;
}

}  // namespace treeform::detail::arrange
