#include <libmesh/base/point_math.hpp>
#include <libmesh/place/quickhull.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

void check_points(points_view points) {
    if (points.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(
            "treeform::convex_hull: more points than 32-bit numbers can name");
    detail::place::check_finite("convex_hull", points);
}

/// The point of the highest score for which `holds`: asked of the highest alone at first, since it
/// is the one except for rounding; the lowest number of equals. None when it holds for no point.
template <class Score, class Holds>
std::optional<std::uint32_t> best_point(std::size_t count, const Score& score, const Holds& holds) {
    std::uint32_t best = 0;
    double highest = -1.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double one = score(i);
        if (one > highest) {
            highest = one;
            best = i;
        }
    }
    if (count != 0 && holds(best)) return best;
    for (std::uint32_t i = 0; i < count; ++i)
        if (holds(i)) return i;
    return std::nullopt;
}

/// The first corners of a hull: as many points as the points have dimensions, and one more.
struct first_simplex {
    int dimension = -1;
    std::array<std::uint32_t, 4> corner{};
};

first_simplex find_simplex(points_view points, const detail::place::scaled_points& scaled) {
    first_simplex s;
    if (points.empty()) return s;
    // Not bindings: clang 14 lets no lambda have them.
    std::uint32_t &a = s.corner[0], &b = s.corner[1], &c = s.corner[2], &d = s.corner[3];
    const std::size_t count = points.size();
    for (std::uint32_t i = 1; i < count; ++i) {
        const point3 &p = points[i], &q = points[a];
        if (std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z}) a = i;
    }
    s.dimension = 0;
    const auto from_a = [&](std::uint32_t i) { return scaled.difference(i, a); };
    const auto off_a = [&](std::uint32_t i) { return detail::base::dot(from_a(i), from_a(i)); };
    const auto other = best_point(count, off_a, [&](auto i) { return points[i] != points[a]; });
    if (!other) return s;
    b = *other;
    s.dimension = 1;
    const auto off_line = [&](std::uint32_t i) {
        const point3 n = detail::base::cross(from_a(b), from_a(i));
        return detail::base::dot(n, n);
    };
    const auto third = best_point(
        count, off_line, [&](auto i) { return !collinear(points[a], points[b], points[i]); });
    if (!third) return s;
    c = *third;
    s.dimension = 2;
    const point3 n = detail::base::cross(from_a(b), from_a(c));
    const auto off_plane = [&](std::uint32_t i) {
        return std::abs(detail::base::dot(n, from_a(i)));
    };
    const auto side = [&](std::uint32_t i) {
        return orient3d(points[a], points[b], points[c], points[i]);
    };
    const auto fourth = best_point(count, off_plane, [&](auto i) { return side(i) != 0; });
    if (!fourth) return s;
    d = *fourth;
    s.dimension = 3;
    if (side(d) > 0) std::swap(b, c);  // d is to be below the face a, b, c
    return s;
}

/// The hull of points in a plane, as seen along the axis that a triangle of them shows its face
/// to: counter-clockwise, without corners at which it does not turn. (Andrew's monotone chain.)
std::vector<std::uint32_t> polygon_around(points_view points, int axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3);
    const auto v = static_cast<std::size_t>((axis + 2) % 3);
    const auto key = [&](std::uint32_t i) { return std::pair(points[i][u], points[i][v]); };
    std::vector<std::uint32_t> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](auto i, auto j) { return key(i) != key(j) ? key(i) < key(j) : i < j; });
    order.erase(
        std::unique(order.begin(), order.end(), [&](auto i, auto j) { return key(i) == key(j); }),
        order.end());
    std::vector<std::uint32_t> hull;
    const auto add = [&](std::uint32_t i, std::size_t least) {
        while (hull.size() > least &&
               orient2d(axis, points[hull[hull.size() - 2]], points[hull.back()], points[i]) <= 0)
            hull.pop_back();
        hull.push_back(i);
    };
    for (const std::uint32_t i : order) add(i, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = order.size() - 1; i-- > 0;) add(order[i], lower);
    hull.pop_back();
    return hull;
}

/// Both sides of a convex polygon, cut in triangles from its lowest number.
std::vector<std::vector<face>> faces_of_polygon(std::vector<std::uint32_t> polygon) {
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    std::vector<std::vector<face>> sides(2);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        sides[0].push_back({polygon[0], polygon[i - 1], polygon[i]});
        sides[1].push_back({polygon[0], polygon[i], polygon[i - 1]});
    }
    return sides;
}

int axis_that_sees(const point3& a, const point3& b, const point3& c) {
    int axis = 0;
    while (axis < 2 && orient2d(axis, a, b, c) == 0) ++axis;
    return axis;
}

/// `a` - `b` as the sum of two doubles, without error.
struct exact_difference {
    double high, low;
    exact_difference(double a, double b) : high(a - b) {
        const double shift = high - a;
        low = (a - (high - shift)) + (-b - shift);
    }
};

/// a b - c d with an error of 2 u of itself. \source Kahan; Jeannerod, Louvet and Muller (2013)
double difference_of_products(double a, double b, double c, double d) {
    const double product = c * d;
    return std::fma(a, b, -product) + std::fma(-c, d, product);
}

/// (b - a) x (c - a) times by^2 as if computed with twice the digits: slivers have a normal, too.
point3 careful_cross(const point3& a, const point3& b, const point3& c, double by) {
    const auto times = [&](double x, double y) {
        const exact_difference d(0.5 * x, 0.5 * y);
        return std::pair(d.high * by, d.low * by);
    };
    point3 n;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const auto [bu, bu_low] = times(b[u], a[u]);
        const auto [bv, bv_low] = times(b[v], a[v]);
        const auto [cu, cu_low] = times(c[u], a[u]);
        const auto [cv, cv_low] = times(c[v], a[v]);
        n[k] = difference_of_products(bu, cv, bv, cu) +
               (bu * cv_low + bu_low * cv - bv * cu_low - bv_low * cu);
    }
    return n;
}

point3 of_length_1(point3 n) {
    const double most = detail::base::largest_of(n);
    if (most == 0.0) return n;
    n = {n.x / most, n.y / most, n.z / most};
    const double length = std::sqrt(detail::base::dot(n, n));
    return {n.x / length, n.y / length, n.z / length};
}

/// Area, normal and center of the faces of a side.
void measure(hull_side& side, std::span<const face> faces, points_view points) {
    // Differences are halved, so that none overflows; then brought to the size of 1.
    const point3 base = points[faces[0][0]];
    const auto halved = [&](std::uint32_t i, std::size_t k) {
        return 0.5 * points[i][k] - 0.5 * base[k];
    };
    double largest = 0.0;
    for (const face& f : faces)
        for (const std::uint32_t i : f)
            for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(halved(i, k)));
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double by = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    const auto at = [&](std::uint32_t i) {
        return point3{by * halved(i, 0), by * halved(i, 1), by * halved(i, 2)};
    };
    point3 normal, moment;
    double total = 0.0, widest = -1.0, spread = 0.0;
    face widest_face{};
    for (const face& f : faces) {
        const point3 a = at(f[0]), e = detail::base::minus(at(f[1]), a),
                     g = detail::base::minus(at(f[2]), a);
        const point3 n = detail::base::cross(e, g);
        const double twice = std::sqrt(detail::base::dot(n, n));
        total += twice;
        for (std::size_t k = 0; k < 3; ++k) {
            normal[k] += n[k];
            moment[k] += twice * (a[k] + (e[k] + g[k]) / 3.0);
        }
        if (twice > widest) {
            widest = twice;
            spread = std::sqrt(detail::base::dot(e, e) * detail::base::dot(g, g));
            widest_face = f;
        }
    }
    if (widest < 0x1p-20 * spread) {  // the cross products have lost that many digits
        const auto& [a, b, c] = widest_face;
        normal = careful_cross(points[a], points[b], points[c], by);
    }
    side.normal = of_length_1(normal);
    for (std::size_t k = 0; k < 3; ++k)
        side.center[k] = base[k] + (total > 0.0 ? 2.0 * (moment[k] / total / by) : 0.0);
    side.area = 2.0 * total / by / by;
}

convex_hull_result joined(std::vector<std::vector<face>> sides, points_view points, int dimension) {
    for (std::vector<face>& faces : sides) {
        for (face& f : faces) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        std::sort(faces.begin(), faces.end());
    }
    std::sort(sides.begin(), sides.end());
    convex_hull_result hull;
    hull.dimension = dimension;
    for (const std::vector<face>& faces : sides) {
        hull_side& side = hull.sides.emplace_back();
        side.first_face = static_cast<std::uint32_t>(hull.faces.size());
        side.face_count = static_cast<std::uint32_t>(faces.size());
        hull.faces.insert(hull.faces.end(), faces.begin(), faces.end());
        measure(side, faces, points);
    }
    return hull;
}

convex_hull_result hull_of(points_view points, detail::base::work_progress& work) {
    const detail::place::scaled_points scaled(points);
    const first_simplex first = find_simplex(points, scaled);
    if (first.dimension < 2) return {.dimension = first.dimension};
    const auto& [a, b, c, d] = first.corner;
    if (first.dimension == 2) {
        const int axis = axis_that_sees(points[a], points[b], points[c]);
        return joined(faces_of_polygon(polygon_around(points, axis)), points, 2);
    }
    detail::place::quickhull hull(points, scaled, first.corner);
    if (!hull.run(work)) return {.status = status::cancelled};
    return joined(hull.sides(), points, 3);
}

}  // namespace

convex_hull_result convex_hull(points_view points, const progress_callback& progress) {
    check_points(points);
    detail::base::work_progress work(progress);
    convex_hull_result hull = hull_of(points, work);
    work.reach(1.0);
    return hull;
}

std::vector<std::uint32_t> convex_hull_result::corners_of(const hull_side& side,
                                                          points_view points) const {
    using edge = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<edge> edges;
    for (const face& f : faces_of(side))
        for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(f[i], f[(i + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    // An edge inside the side is there in both directions; those of the rim follow each other.
    std::vector<edge> rim;
    for (const auto& [from, to] : edges)
        if (!std::binary_search(edges.begin(), edges.end(), edge(to, from)))
            rim.emplace_back(from, to);
    std::vector<std::uint32_t> around;
    if (rim.empty()) return around;
    std::uint32_t at = rim[0].first;
    do {
        around.push_back(at);
        at = std::lower_bound(rim.begin(), rim.end(), edge(at, 0))->second;
    } while (at != rim[0].first && around.size() < rim.size());
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < around.size(); ++i) {
        const std::uint32_t before = around[(i + around.size() - 1) % around.size()];
        const std::uint32_t next = around[(i + 1) % around.size()];
        if (!collinear(points[before], points[around[i]], points[next]))
            corners.push_back(around[i]);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

}  // namespace treeform
