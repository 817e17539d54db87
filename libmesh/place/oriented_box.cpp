#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/convex_hull.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;

point3 of_length_one(const point3& v) {
    const double most = detail::base::largest_of(v);
    if (!(most > 0.0)) return {1.0, 0.0, 0.0};
    const point3 near{v.x / most, v.y / most, v.z / most};
    const double length = std::hypot(near.x, near.y, near.z);
    return {near.x / length, near.y / length, near.z / length};
}

/// Some axis across n.
point3 across(const point3& n) {
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::abs(n[k]) < std::abs(n[least])) least = k;
    point3 e{};
    e[least] = 1.0;
    return of_length_one(cross(n, e));
}

/// Corners of a polygon in the plane, counter-clockwise: of the convex hull of `points`, as doubles
/// say.
std::vector<point2> outline_of(std::vector<point2> points) {
    std::ranges::sort(points, [](const point2& a, const point2& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    });
    std::vector<point2> rim;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = rim.size();
        for (const point2& p : points) {
            while (rim.size() >= first + 2) {
                const point2 &a = rim[rim.size() - 2], &b = rim.back();
                if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0) break;
                rim.pop_back();
            }
            rim.push_back(p);
        }
        rim.pop_back();
        std::ranges::reverse(points);
    }
    return rim;
}

/// The box along these axes.
oriented_box box_along(std::span<const point3> points, const std::array<point3, 3>& axes) {
    oriented_box box{.axes = axes};
    for (std::size_t k = 0; k < 3; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const point3& p : points) {
            const double at = dot(axes[k], p);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        box.size[k] = high - low;
        for (std::size_t i = 0; i < 3; ++i) box.center[i] += (low + (high - low) / 2) * axes[k][i];
    }
    return box;
}

double volume_of(const oriented_box& box) { return box.size.x * box.size.y * box.size.z; }
double rim_of(const oriented_box& box) {
    return box.size.x * box.size.y + box.size.y * box.size.z + box.size.z * box.size.x;
}

/// The direction, in the plane across n, of a side of the least rectangle.
point3 best_side(std::span<const point3> points, const point3& n) {
    const point3 u = across(n), v = cross(n, u);
    std::vector<point2> flat;
    flat.reserve(points.size());
    for (const point3& p : points) flat.push_back({dot(u, p), dot(v, p)});
    const std::vector<point2> rim = outline_of(std::move(flat));
    if (rim.size() < 2) return u;
    double least = std::numeric_limits<double>::infinity();
    point2 best{1.0, 0.0};
    // Calipers: the furthest corner ahead, to the left and behind only go forward.
    std::array<std::size_t, 3> far{0, 0, 0};
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const point2 &p = rim[i], &q = rim[(i + 1) % rim.size()];
        const double length = std::hypot(q.x - p.x, q.y - p.y);
        if (!(length > 0.0)) continue;
        const point2 d{(q.x - p.x) / length, (q.y - p.y) / length};
        const std::array<point2, 3> ways{d, point2{-d.y, d.x}, point2{-d.x, -d.y}};
        std::array<double, 3> reach{};
        for (std::size_t w = 0; w < 3; ++w) {
            const auto at = [&](std::size_t j) {
                const point2& r = rim[j % rim.size()];
                return ways[w].x * (r.x - p.x) + ways[w].y * (r.y - p.y);
            };
            far[w] = std::max(far[w], w == 0 ? i : far[w - 1]);
            while (far[w] < i + 2 * rim.size() && at(far[w] + 1) >= at(far[w])) ++far[w];
            reach[w] = at(far[w]);
        }
        const double area = (reach[0] + reach[2]) * reach[1];
        if (!(area < least)) continue;
        least = area;
        best = d;
    }
    return of_length_one(
        {best.x * u.x + best.y * v.x, best.x * u.y + best.y * v.y, best.x * u.z + best.y * v.z});
}

/// With the longest side first.
oriented_box in_order(oriented_box box) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return box.size[a] > box.size[b]; });
    oriented_box result{.center = box.center};
    for (std::size_t k = 0; k < 3; ++k) {
        result.axes[k] = box.axes[order[k]];
        result.size[k] = box.size[order[k]];
    }
    result.axes[2] = cross(result.axes[0], result.axes[1]);
    return result;
}

}  // namespace

mesh convex_hull_result::mesh(points_view points) const {
    treeform::mesh made;
    std::vector<std::uint32_t> number(points.size(), 0);
    for (const face& f : faces)
        for (const std::uint32_t v : f) number[v] = 1;
    for (std::size_t v = 0; v < points.size(); ++v)
        if (number[v] != 0) {
            number[v] = static_cast<std::uint32_t>(made.points.size());
            made.points.push_back(points[v]);
        }
    for (const face& f : faces) made.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
    return made;
}

std::optional<oriented_box> find_oriented_box(points_view points) {
    constexpr std::size_t most_corners = std::size_t{1} << 26;
    const convex_hull_result hull = convex_hull(points);
    if (hull.dimension < 0) return std::nullopt;
    if (hull.dimension < 2) {
        const auto [low, high] = std::ranges::minmax_element(points, {}, [](const point3& p) {
            return std::array{p.x, p.y, p.z};
        });
        const point3 x = of_length_one(
            {high->x / 2 - low->x / 2, high->y / 2 - low->y / 2, high->z / 2 - low->z / 2});
        const point3 y = across(x);
        return in_order(box_along(points, {x, y, cross(x, y)}));
    }
    const std::vector<point3> corners = hull.mesh(points).points;
    std::vector<std::size_t> sides(hull.sides.size());
    std::iota(sides.begin(), sides.end(), std::size_t{0});
    const std::size_t most = std::max<std::size_t>(1, most_corners / corners.size());
    if (sides.size() > most) {
        std::ranges::stable_sort(sides, [&](std::size_t a, std::size_t b) {
            return hull.sides[a].area > hull.sides[b].area;
        });
        sides.resize(most);
    }
    std::vector<oriented_box> boxes(sides.size());
    boxes.push_back(box_along(corners, oriented_box{}.axes));
    detail::base::for_numbers(sides.size(), 16, [&](std::size_t i) {
        const point3& n = hull.sides[sides[i]].normal;
        const point3 x = best_side(corners, n);
        boxes[i] = box_along(corners, {x, of_length_one(cross(n, x)), n});
    });
    const auto best = std::ranges::min_element(
        boxes, {}, [](const oriented_box& box) { return std::pair(volume_of(box), rim_of(box)); });
    return in_order(*best);
}

}  // namespace treeform
