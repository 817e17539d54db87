#include <libmesh/base/face_tree.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/settle.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform {
namespace {

std::vector<point3> moved_points(mesh_view a, const point3& motion, double time, bool to_single) {
    std::vector<point3> points(a.points.begin(), a.points.end());
    for (point3& p : points)
        for (std::size_t k = 0; k < 3; ++k) {
            const double product = time * motion[k];
            p[k] += product;
            if (to_single) p[k] = detail::base::nearest_float(p[k]);
        }
    return points;
}

/// The least time that moves a coordinate of `points` by a unit in the last place of the largest.
double unit_of_time(const std::vector<point3>& points, const point3& motion, bool to_single) {
    double largest = 0.0;
    double speed = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        speed = std::max(speed, std::abs(motion[k]));
        if (motion[k] == 0.0) continue;
        for (const point3& p : points) largest = std::max(largest, std::abs(p[k]));
    }
    if (largest == 0.0) return std::numeric_limits<double>::denorm_min() / speed;
    const double unit = std::ldexp(1.0, std::ilogb(largest) - (to_single ? 23 : 52));
    return std::max(unit, std::numeric_limits<double>::denorm_min()) / speed;
}

}  // namespace

settled_mesh settle(mesh_view a, mesh_view b, const tree<3>& tree_b, const point3& motion,
                    double time, const settle_options& options) {
    double speed = 0.0;
    for (std::size_t k = 0; k < 3; ++k) speed = std::max(speed, std::abs(motion[k]));
    if (!(std::isfinite(speed) && speed > 0.0) || !(time >= 0.0) || !std::isfinite(time))
        throw std::invalid_argument(
            "treeform::settle: the motion or the time is not finite, or zero");

    detail::base::work_progress work(options.progress);
    std::size_t tries = 0;
    const auto go_on = [&](double) { return work.step(0.0, 0.9, tries, 4.0); };
    const auto at = [&](double when) {
        ++tries;
        settled_mesh one;
        one.time = when;
        one.points = moved_points(a, motion, when, options.to_single);
        const mesh_view there{one.points, a.faces};
        if (go_on(0.0)) one.relation = relation(there, face_tree(there), b, tree_b, go_on).relation;
        return one;
    };
    /// From a place that is separate on by single units, while nothing is penetrated.
    const auto closed_in = [&](settled_mesh place) {
        const double unit = unit_of_time(place.points, motion, options.to_single);
        for (int steps = 0; options.close_in && place.relation == mesh_relation::separate &&
                            steps < 4 && !work.cancelled();
             ++steps) {
            settled_mesh next = at(place.time + unit);
            if (next.relation == mesh_relation::penetrating) break;
            next.backed_off = place.backed_off;
            place = std::move(next);
        }
        work.reach(1.0);
        place.cancelled = work.cancelled();
        return place;
    };
    settled_mesh best = at(time);
    if (best.relation != mesh_relation::penetrating) return closed_in(std::move(best));

    double step = unit_of_time(best.points, motion, options.to_single);
    double bad = time;
    while (best.relation == mesh_relation::penetrating && best.backed_off < options.attempts) {
        const unsigned count = best.backed_off + 1;
        bad = best.time;
        best = at(time - step);
        best.backed_off = count;
        step *= 2.0;
    }
    // The first place that does not penetrate may be far behind the last one that does.
    const double unit = unit_of_time(best.points, motion, options.to_single);
    while (best.relation != mesh_relation::penetrating && bad - best.time > 2.0 * unit &&
           best.backed_off < options.attempts && !work.cancelled()) {
        const unsigned count = best.backed_off + 1;
        settled_mesh middle = at(best.time + (bad - best.time) / 2);
        if (middle.relation == mesh_relation::penetrating)
            bad = middle.time;
        else
            best = std::move(middle);
        best.backed_off = count;
    }
    return closed_in(std::move(best));
}

}  // namespace treeform
