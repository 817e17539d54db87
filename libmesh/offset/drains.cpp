#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/prism.hpp>
#include <libmesh/offset/drains.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace treeform::detail::offset {
namespace {

using base::dot;
using base::minus;
using base::plus;
using base::scaled;

constexpr std::uint32_t drain_sides = 32;
constexpr double clear = 1e-6;  ///< of the wall: hits before are where the ray begins

/// How far one may go on beyond `t`: `most`, or half of the way to the next face.
double room_beyond(const prepared_mesh& mesh, const ray3& ray, double t, double most) {
    const std::array rays{ray};
    for (const mesh_hit& hit : raycast_all(mesh, rays).answers)
        if (hit.t > t) return std::min(most, 0.5 * (hit.t - t));
    return most;
}

}  // namespace

drilled drill(const point3& at, double diameter, const prepared_mesh& solid,
              const prepared_mesh& cavities) {
    const point3 from = closest_point(solid, at)->point;
    const point3 way = minus(closest_point(cavities, from)->point, from);
    const double length = std::sqrt(dot(way, way));
    const point3 along = scaled(way, 1.0 / length), back = scaled(along, -1.0);
    const double in = room_beyond(cavities, {{from.x, from.y, from.z}, {along.x, along.y, along.z}},
                                  length * (1.0 + clear), diameter);
    const double out = room_beyond(solid, {{from.x, from.y, from.z}, {back.x, back.y, back.z}},
                                   length * clear, diameter);
    const std::array ends{plus(from, scaled(back, out)), plus(from, scaled(along, length + in))};
    const auto [x, y, normal] = oriented_plane{{}, along}.axes();
    // A closed surface has an inside, whichever way it faces.
    return {geometry::prism(ends, {x, y}, 0.5 * diameter, drain_sides),
            !contains(solid, ends[0]) && contains(cavities, ends[1])};
}

}  // namespace treeform::detail::offset
