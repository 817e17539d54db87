#include <libmesh/base/finite.hpp>
#include <libmesh/base/work_progress.hpp>
#include <treeform/mesh/mate.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace treeform {

point3 way_between(const mesh_measure& nearest) {
    const point3 &p = nearest.on_a.point, &q = nearest.on_b.point;
    const point3 way{q.x - p.x, q.y - p.y, q.z - p.z};
    if (!detail::base::is_finite(way))
        throw std::overflow_error("treeform::mate: the meshes are too far from each other");
    return way;
}

mate_result mate(const mesh_measure& nearest, mesh_view a, const tree<3>& tree_a,
                 std::span<const still_part> parts, const mate_options& options) {
    mate_result result{.nearest = nearest};
    if (nearest.relation.relation != mesh_relation::separate) return result;
    result.motion = way_between(nearest);
    if (result.motion == point3{}) return result;
    // Nothing is nearer than the nearest point. Corners that are to meet there may miss each other
    // by the rounding of their distance.
    result.met = slide(a, tree_a, parts, result.motion,
                       {.clearance = options.clearance,
                        .latest = 1.0 + 0x1p-20,
                        .limit = options.limit,
                        .progress = options.progress});
    result.cancelled = result.met.cancelled;
    result.time = result.met.end == motion_end::free
                      ? std::max(0.0, 1.0 - options.clearance / nearest.distance)
                      : result.met.time;
    return result;
}

std::optional<mate_result> mate(mesh_view a, const tree<3>& tree_a,
                                std::span<const still_part> parts, const mate_options& options) {
    detail::base::work_progress work(options.progress);
    const double share = 0.5 / static_cast<double>(std::max<std::size_t>(parts.size(), 1));
    std::optional<mate_result> found;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto before = static_cast<double>(i);
        const double radius =
            found ? found->nearest.distance : std::numeric_limits<double>::infinity();
        auto how = measure(
            a, tree_a, parts[i].mesh, *parts[i].faces,
            {.radius = radius, .progress = work.part(before * share, (before + 1.0) * share)});
        if (work.cancelled()) return mate_result{.cancelled = true};
        if (!how) continue;
        const mesh_relation relation = how->relation.relation;
        const bool better = !found || relation > found->nearest.relation.relation ||
                            (relation == found->nearest.relation.relation &&
                             how->distance < found->nearest.distance);
        if (better) found = mate_result{.part = i, .nearest = *how};
    }
    mate_options rest = options;
    rest.progress = work.part(0.5, 1.0);
    if (found) {
        const std::size_t part = found->part;
        found = mate(found->nearest, a, tree_a, parts, rest);
        found->part = part;
    }
    work.reach(1.0);
    return found;
}

}  // namespace treeform
