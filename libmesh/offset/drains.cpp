#include <libmesh/base/point_math.hpp>
#include <libmesh/offset/drains.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace treeform::detail::offset {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::plus;
using base::scaled;

constexpr std::uint32_t drain_sides = 32;
constexpr double clear = 1e-6;  ///< of the wall: hits before are where the ray begins

/// How far one may go on beyond `t`: `most`, or half of the way to the next face.
double room_beyond(const prepared_mesh& mesh, const ray3& ray, double t, double most) {
    const std::array rays{ray};
    for (const mesh_hit& hit : raycast_all(mesh, rays).hits)
        if (hit.t > t) return std::min(most, 0.5 * (hit.t - t));
    return most;
}

mesh prism_of(const std::array<point3, 2>& ends, const point3& along, double radius) {
    point3 least{};
    const std::array<double, 3> size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
    least[static_cast<std::size_t>(std::min_element(size.begin(), size.end()) - size.begin())] = 1;
    point3 u = cross(along, least);
    u = scaled(u, 1.0 / std::sqrt(dot(u, u)));
    const point3 v = cross(along, u);
    mesh prism;
    for (const point3& end : ends)
        for (std::uint32_t i = 0; i < drain_sides; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / drain_sides;
            const point3 out = plus(scaled(u, std::cos(turn)), scaled(v, std::sin(turn)));
            prism.points.push_back(plus(end, scaled(out, radius)));
        }
    constexpr std::uint32_t n = drain_sides;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        prism.faces.push_back({i, next, next + n});
        prism.faces.push_back({i, next + n, i + n});
        if (i == 0 || next == 0) continue;
        prism.faces.push_back({0, next, i});
        prism.faces.push_back({n, i + n, next + n});
    }
    return prism;
}

}  // namespace

drilled drill(const drain& hole, const prepared_mesh& solid, const prepared_mesh& cavities) {
    const point3 from = closest_point(solid, hole.at)->point;
    const point3 way = minus(closest_point(cavities, from)->point, from);
    const double length = std::sqrt(dot(way, way));
    const point3 along = scaled(way, 1.0 / length), back = scaled(along, -1.0);
    const double in = room_beyond(cavities, {{from.x, from.y, from.z}, {along.x, along.y, along.z}},
                                  length * (1.0 + clear), hole.diameter);
    const double out = room_beyond(solid, {{from.x, from.y, from.z}, {back.x, back.y, back.z}},
                                   length * clear, hole.diameter);
    const std::array ends{plus(from, scaled(back, out)), plus(from, scaled(along, length + in))};
    // A closed surface has an inside, whichever way it faces.
    return {prism_of(ends, along, 0.5 * hole.diameter),
            !contains(solid, ends[0]) && contains(cavities, ends[1])};
}

}  // namespace treeform::detail::offset
