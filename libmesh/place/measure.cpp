#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/relation_of.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::minus;
using detail::base::triangle_of;

using weights = std::array<double, 3>;

/// How far the point that the weights give is from `p`, squared.
double squared_miss(const triangle3& t, const weights& w, const point3& p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double miss =
            w[0] * (t[0][k] - p[k]) + w[1] * (t[1][k] - p[k]) + w[2] * (t[2][k] - p[k]);
        sum += miss * miss;
    }
    return sum;
}

/// Along the edge from corner i to corner j.
weights on_edge(const triangle3& t, std::size_t i, std::size_t j, const point3& p) {
    const point3 edge = minus(t[j], t[i]);
    const double length = dot(edge, edge);
    const double share =
        length > 0.0 ? std::clamp(dot(minus(p, t[i]), edge) / length, 0.0, 1.0) : 0.0;
    weights w{};
    w[j] = share;
    w[i] = 1.0 - share;
    return w;
}

/// By areas; all 0 where there is none.
weights by_area(const triangle3& t, const point3& p) {
    const point3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    weights w{};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const point3 part = cross(minus(t[(i + 1) % 3], p), minus(t[(i + 2) % 3], p));
        w[i] = std::max(0.0, dot(normal, part));
        sum += w[i];
    }
    for (double& one : w) one = sum > 0.0 ? one / sum : 0.0;
    return w;
}

surface_point surface_point_of(mesh_view mesh, std::uint32_t face, const point3& p) {
    return {face, p, detail::place::barycentric_weights(triangle_of(mesh, face), p)};
}

bool boxes_meet(mesh_view a, mesh_view b) {
    const auto box_a = bounding_box(a.points), box_b = bounding_box(b.points);
    if (!box_a || !box_b) return true;
    for (std::size_t k = 0; k < 3; ++k)
        if (!(box_a->min[k] <= box_b->max[k] && box_b->min[k] <= box_a->max[k])) return false;
    return true;
}

}  // namespace

std::array<double, 3> detail::place::barycentric_weights(const std::array<point3, 3>& t,
                                                         const point3& p) {
    // Areas of a sliver say little, an edge of it then says more: what gives the point best is
    // taken.
    weights best = on_edge(t, 0, 1, p);
    double least = squared_miss(t, best, p);
    const auto offer = [&](const weights& w) {
        const double miss = squared_miss(t, w, p);
        if (!(miss < least)) return;
        least = miss;
        best = w;
    };
    offer(on_edge(t, 1, 2, p));
    offer(on_edge(t, 2, 0, p));
    const weights inside = by_area(t, p);
    if (inside[0] + inside[1] + inside[2] > 0.5) offer(inside);
    return best;
}

std::optional<relation_result> detail::place::measure_of(const shape& of_a, const shape& of_b,
                                                         double radius,
                                                         const progress_callback& progress) {
    const mesh_view a = of_a.mesh(), b = of_b.mesh();
    if (a.faces.empty() || b.faces.empty()) return std::nullopt;
    detail::base::work_progress work(progress);
    relation_result result;
    if (boxes_meet(a, b)) result = relation_of(of_a, of_b, work.part(0.0, 0.5));
    if (!work.reach(0.5)) result = {.status = status::cancelled};
    if (work.cancelled()) return result;
    if (result.relation != mesh_relation::disjoint) {
        const std::uint32_t f = result.face_a, g = result.face_b;
        const auto common = closest_pair(triangle_of(a, f), triangle_of(b, g));
        if (common.squared_distance == 0.0) {
            result.on_a = surface_point_of(a, f, common.on_a);
            result.on_b = surface_point_of(b, g, common.on_b);
            work.reach(1.0);
            return result;
        }
    }
    const bool disjoint = result.relation == mesh_relation::disjoint;
    const auto nearest =
        detail::nearness::closest_pair(a, of_a.faces(), b, of_b.faces(),
                                       disjoint ? radius : std::numeric_limits<double>::infinity());
    work.reach(1.0);
    if (!nearest) return std::nullopt;
    result.surface_distance = nearest->distance;
    if (disjoint) result.distance = nearest->distance;
    result.on_a = surface_point_of(a, nearest->face_a, nearest->on_a);
    result.on_b = surface_point_of(b, nearest->face_b, nearest->on_b);
    return result;
}

std::optional<relation_result> measure(const mesh_ref& given_a, const mesh_ref& given_b,
                                       const measure_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    detail::place::check_operand("measure", "a", a);
    detail::place::check_operand("measure", "b", b);
    return detail::place::measure_of(detail::place::shape(a, options.vertices),
                                     detail::place::shape(b, options.vertices), options.radius,
                                     options.progress);
}

}  // namespace treeform
