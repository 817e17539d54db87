#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/measure.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace treeform {
namespace {

using detail::base::dot;
using detail::base::minus;

constexpr double endless_wall = std::numeric_limits<double>::infinity();

point3 outward(mesh_view mesh, std::uint32_t f) {
    return detail::place::normal_of(detail::base::triangle_of(mesh, f));
}

point3 middle(mesh_view mesh, std::uint32_t f) {
    point3 sum;
    for (const std::uint32_t v : mesh.faces[f])
        for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh.points[v][k] / 3;
    return sum;
}

/// From the middle of a face to the first other one that the ray leaves through.
double along_ray(mesh_view mesh, std::uint32_t f, const point3& inward,
                 std::span<const mesh_hit> hits) {
    for (const mesh_hit& hit : hits)
        if (hit.face != f && !hit.coplanar && dot(outward(mesh, hit.face), inward) > 0.0)
            return hit.t;
    return endless_wall;
}

/// The largest ball within, from one that is too large: it shrinks to what it holds of the surface.
double ball_at(const prepared_mesh& mesh, const point3& p, const point3& n, double diameter) {
    constexpr int most_steps = 64;
    double radius = diameter / 2;
    for (int step = 0; step < most_steps; ++step) {
        const point3 center = minus(p, detail::base::scaled(n, radius));
        const auto near = closest_point(mesh, center);
        if (!near || near->distance >= radius * (1.0 - 0x1p-21)) break;
        const point3& q = near->point;
        const point3 d = minus(p, q);
        const double across = dot(n, d);
        const double smaller = dot(d, d) / (2 * across);
        if (!(across > 0.0) || !(smaller < radius)) break;
        radius = smaller;
    }
    return 2 * radius;
}

}  // namespace

thickness_result wall_thickness(const mesh_ref& given, thickness_by by,
                                const progress_callback& report) {
    constexpr std::size_t rays_at_once = 1024;
    const mesh_view mesh = given.view();
    detail::base::check_faces("wall_thickness", mesh.points.size(), mesh.faces);
    detail::base::check_finite_faces("wall_thickness", mesh);
    const detail::base::prepared_ref held(given);
    const prepared_mesh& prepared = held;
    detail::base::work_progress progress(report);
    thickness_result result;
    result.of_face.assign(mesh.faces.size(), endless_wall);
    std::atomic<std::size_t> done{0};
    for_chunks(mesh.faces.size(), rays_at_once, [&](std::size_t begin, std::size_t end, auto) {
        if (progress.cancelled()) return;
        std::vector<ray3> rays;
        std::vector<std::uint32_t> of_ray;
        std::vector<point3> from, inward;
        for (auto f = static_cast<std::uint32_t>(begin); f < end; ++f) {
            const point3 n = outward(mesh, f);
            if (n == point3{}) continue;
            from.push_back(middle(mesh, f));
            inward.push_back({-n.x, -n.y, -n.z});
            rays.push_back({{from.back().x, from.back().y, from.back().z}, {-n.x, -n.y, -n.z}});
            of_ray.push_back(f);
        }
        const answer_lists<mesh_hit> met = raycast_all(prepared, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::span hits =
                std::span(met.answers).subspan(met.begin[i], met.begin[i + 1] - met.begin[i]);
            double& thickness = result.of_face[of_ray[i]];
            thickness = along_ray(mesh, of_ray[i], inward[i], hits);
            const point3 n{-inward[i].x, -inward[i].y, -inward[i].z};
            if (by == thickness_by::sphere && thickness < endless_wall)
                thickness = ball_at(prepared, from[i], n, thickness);
        }
        progress.reach(static_cast<double>(done += end - begin) /
                       static_cast<double>(mesh.faces.size()));
    });
    if (progress.cancelled() || !progress.reach(1.0)) return {.status = status::cancelled};
    for (std::uint32_t f = 0; f < result.of_face.size(); ++f)
        if (result.of_face[f] < result.min) {
            result.min = result.of_face[f];
            result.thinnest = f;
        }
    return result;
}

}  // namespace treeform
