#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/geometry/contact_point.hpp>
#include <libmesh/geometry/triangle_distance.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform {
namespace {

using detail::base::dot;
using detail::base::minus;

point3 along(const point3& p, double t, const point3& d) {
    return {p.x + t * d.x, p.y + t * d.y, p.z + t * d.z};
}
double clamped(double t) { return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t; }

void keep(closest_between_triangles& best, const point3& on_a, const point3& on_b, double squared) {
    if (squared < best.squared_distance) best = {on_a, on_b, squared};
}

/// A candidate: where the edges p + s d and q + t e come nearest.
///
/// Across d, as if looking along it, r and e are seen as r' and e', and t is where the line of e
/// passes nearest to a point: no determinant that cancels. Where the edges are nearly parallel, e'
/// is short and t far off, but then it does not matter: the error of t is a rounding of the lengths
/// over |e'|, and moves the distance by |e'| times that. Ends are clamped, and each parameter
/// projected once more in turn. All candidates are points of the edges, so none is too near.
void between_edges(const point3& p, const point3& d, const point3& q, const point3& e,
                   closest_between_triangles& best) {
    const double dd = dot(d, d), ee = dot(e, e);
    if (!(dd > 0.0 && ee > 0.0)) return;  // corners see to it
    const point3 r = minus(p, q);
    const point3 r_across = along(r, -dot(r, d) / dd, d);
    const point3 e_across = along(e, -dot(e, d) / dd, d);
    const double square = dot(e_across, e_across);
    double t = clamped(square > 0.0 ? dot(r_across, e_across) / square : 0.5);
    const double s = clamped(-dot(along(r, -t, e), d) / dd);
    t = clamped(dot(along(r, s, d), e) / ee);
    const point3 gap = along(along(r, s, d), -t, e);
    keep(best, along(p, s, d), along(q, t, e), dot(gap, gap));
}

/// Whether the direction between the nearest points separates the triangles for sure.
///
/// With u = 2^-53 and L the largest distance of two corners, a coordinate difference from `on_a`,
/// its product with n and the sums put each term below off by at most 8 u |n| L, and L is at most
/// 4 `reach`. Where products underflow, nothing exceeds the right side.
bool separated(const triangle3& a, const triangle3& b, const closest_between_triangles& found) {
    const point3 n = minus(found.on_b, found.on_a);
    double most_of_a = -std::numeric_limits<double>::infinity();
    double least_of_b = std::numeric_limits<double>::infinity();
    double reach = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const point3 to_a = minus(a[i], found.on_a);
        const point3 to_b = minus(b[i], found.on_a);
        most_of_a = std::max(most_of_a, dot(n, to_a));
        least_of_b = std::min(least_of_b, dot(n, to_b));
        for (std::size_t k = 0; k < 3; ++k)
            reach = std::max({reach, std::abs(to_a[k]), std::abs(to_b[k])});
    }
    const double size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    return least_of_b - most_of_a > 0x1p-45 * size * reach && size * reach > 0x1p-900;
}

}  // namespace

closest_between_triangles closest_pair(const triangle3& a, const triangle3& b) {
    closest_between_triangles best;
    best.squared_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const closest_on_triangle to_b = closest_point(b, a[i]);
        keep(best, a[i], to_b.point, to_b.squared_distance);
        const closest_on_triangle to_a = closest_point(a, b[i]);
        keep(best, to_a.point, b[i], to_a.squared_distance);
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            between_edges(a[i], minus(a[(i + 1) % 3], a[i]), b[j], minus(b[(j + 1) % 3], b[j]),
                          best);
    // Triangles may pass through each other far from any corner and from any two edges.
    if (separated(a, b, best)) return best;
    const triangle_contact contact = intersect(a, b);
    if (contact.count == 0) {
        best.squared_distance = std::max(best.squared_distance, std::numeric_limits<double>::min());
        return best;
    }
    const point3 common = approximate_point(a, b, contact.ends[0]);
    return {common, common, 0.0};
}

}  // namespace treeform
