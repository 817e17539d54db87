#include <libmesh/base/point_math.hpp>
#include <libmesh/round/edge_points.hpp>
#include <libmesh/round/gather.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>

namespace treeform::detail::round {
namespace {

using base::dot;
using base::minus;

/// Where the lines through two edges are nearest, if that is inside of both.
bool pass(points_view points, double near, passing_edges& e) {
    const point3 &p = points[e.a[0]], &q = points[e.b[0]];
    const point3 u = minus(points[e.a[1]], p), v = minus(points[e.b[1]], q), w = minus(q, p);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double turn = uu * vv - uv * uv;
    if (!(turn > 0x1p-40 * uu * vv)) return false;  // along each other: their ends are near
    const double s = (uw * vv - vw * uv) / turn, t = (uw * uv - vw * uu) / turn;
    if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return false;
    const point3 on_a{p.x + s * u.x, p.y + s * u.y, p.z + s * u.z};
    const point3 on_b{q.x + t * v.x, q.y + t * v.y, q.z + t * v.z};
    const double distance = length(minus(on_a, on_b));
    if (!(distance <= near)) return false;
    e.on_a = {s, distance};
    e.on_b = {t, distance};
    e.between = {(on_a.x + on_b.x) / 2, (on_a.y + on_b.y) / 2, (on_a.z + on_b.z) / 2};
    return true;
}

}  // namespace

place nearest_on(points_view points, std::uint32_t p, const edge_name& e) {
    const point3 &a = points[e[0]], &q = points[p];
    const point3 way = minus(points[e[1]], a);
    const double square = dot(way, way);
    const double along = square > 0.0 ? std::clamp(dot(minus(q, a), way) / square, 0.0, 1.0) : 0.0;
    const point3 there{a.x + along * way.x, a.y + along * way.y, a.z + along * way.z};
    return {along, length(minus(q, there))};
}

std::vector<edge_point> points_near_edges(points_view points, std::span<const std::uint32_t> among,
                                          std::span<const edge_name> edges, double near,
                                          std::size_t most) {
    const tree<3> around =
        build(among, [&](std::uint32_t p) { return box_around(points[p], points[p], 0.0); });
    return gather<edge_point>(
        edges.size(), most, [&](std::size_t i, std::vector<edge_point>& found) {
            const edge_name& e = edges[i];
            search(around, box_around(points[e[0]], points[e[1]], near), [&](std::uint32_t id) {
                const std::uint32_t p = among[id];
                if (p == e[0] || p == e[1]) return;
                const place on = nearest_on(points, p, e);
                if (on.distance <= near) found.push_back({e, on.along, p, on.distance});
            });
        });
}

std::vector<passing_edges> edges_passing(points_view points, std::span<const edge_name> edges,
                                         double near, std::size_t most) {
    const tree<3> around = build(
        edges, [&](const edge_name& e) { return box_around(points[e[0]], points[e[1]], 0.0); });
    auto all = gather<passing_edges>(
        edges.size(), most, [&](std::size_t i, std::vector<passing_edges>& found) {
            const edge_name& a = edges[i];
            search(around, box_around(points[a[0]], points[a[1]], near), [&](std::uint32_t id) {
                const edge_name& b = edges[id];
                if (!(a < b) || a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1])
                    return;
                passing_edges both{.a = a, .b = b};
                if (pass(points, near, both)) found.push_back(both);
            });
        });
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace treeform::detail::round
