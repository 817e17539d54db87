#include <libmesh/base/point_math.hpp>
#include <libmesh/place/mate_motion.hpp>

#include <algorithm>
#include <stdexcept>

namespace treeform::detail::place {

point3 way_between(const mesh_measure& nearest) {
    const point3 &p = nearest.on_a.point, &q = nearest.on_b.point;
    const point3 way{q.x - p.x, q.y - p.y, q.z - p.z};
    if (!base::is_finite(way))
        throw std::overflow_error("treeform::mate: the meshes are too far from each other");
    return way;
}

mate_motion motion_to_mate(const mesh_measure& nearest, const shape& a,
                           std::span<const shape> parts, const sweep_options& options) {
    mate_motion result;
    if (nearest.relation != mesh_relation::separate) return result;
    result.motion = way_between(nearest);
    if (result.motion == point3{}) return result;
    // Nothing is nearer than the nearest point. Corners that are to meet there may miss each other
    // by the rounding of their distance.
    sweep_options rest = options;
    rest.latest = 1.0 + 0x1p-20;
    result.met = sweep_among(a, parts, result.motion, rest);
    result.time = result.met.end == placement_end::nothing_met
                      ? std::max(0.0, 1.0 - options.clearance / nearest.distance)
                      : result.met.time;
    return result;
}

}  // namespace treeform::detail::place
