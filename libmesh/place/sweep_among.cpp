#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/place/sweep_among.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform::detail::place {
namespace {

/// What one part allows.
struct part_end {
    placement_outcome outcome = placement_outcome::nothing_met;
    double time = 0.0;
    sweep_contact exact{};
    std::vector<face_contact> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    predicate_counters predicates{};
    treeform::status status = treeform::status::ok;
};

part_end end_at(const shape& a, const shape& part, const point3& motion, double latest,
                const sweep_options& options, const progress_callback& progress) {
    if (options.clearance > 0.0) {
        auto one = approach_of(
            a.mesh(), a.faces(), part.mesh(), part.faces(), motion, options.clearance,
            {.latest = latest, .limit = options.limit, .progress = progress}, options.effort);
        return {one.outcome,       one.time,         {}, std::move(one.contacts),
                one.contact_count, one.pairs_tested, {}, one.status};
    }
    sweep_contact exact;
    auto one = impact_of(a.mesh(), a.faces(), part.mesh(), part.faces(), motion,
                         {.latest = latest, .limit = options.limit, .progress = progress},
                         options.effort, &exact);
    return {one.outcome,       one.time,         exact,          std::move(one.contacts),
            one.contact_count, one.pairs_tested, one.predicates, one.status};
}

}  // namespace

sweep_result sweep_among(const shape& a, std::span<const shape> parts, const point3& motion,
                         const sweep_options& options) {
    if (!(options.clearance >= 0.0))
        throw std::invalid_argument("treeform::slide: the clearance is negative or NaN");
    sweep_result result;
    sweep_contact earliest;
    double latest = options.latest;
    base::work_progress work(options.progress);
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(parts.size(), 1));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto before = static_cast<double>(i);
        part_end one = end_at(a, parts[i], motion, latest, options,
                              work.part(before * share, (before + 1.0) * share));
        if (work.cancelled() || one.status == status::cancelled)
            return {.status = status::cancelled};
        result.pairs_tested += one.pairs_tested;
        result.predicates += one.predicates;
        if (one.outcome == placement_outcome::nothing_met) continue;
        if (one.outcome == placement_outcome::starts_touching) {
            work.reach(1.0);
            return {.outcome = one.outcome,
                    .part = i,
                    .pairs_tested = result.pairs_tested,
                    .predicates = result.predicates};
        }
        int order = -1;
        if (result.outcome == placement_outcome::contact) {
            order = options.clearance > 0.0 ? (one.time > result.time) - (one.time < result.time)
                                            : compare(motion, one.exact, earliest);
        }
        if (order > 0) continue;
        if (order < 0) {
            result.contacts.clear();
            result.contact_count = 0;
            result.part = i;
            result.outcome = one.outcome;
            result.time = one.time;
            earliest = one.exact;
        }
        result.contact_count += one.contact_count;
        for (const face_contact& c : one.contacts)
            if (result.contacts.size() < options.limit) result.contacts.push_back({i, c});
        // The exact time may lie between two doubles.
        latest =
            std::min(latest, std::nextafter(result.time, std::numeric_limits<double>::infinity()));
    }
    work.reach(1.0);
    return result;
}

point3 way_between(const relation_result& nearest) {
    const point3 &p = nearest.on_a.point, &q = nearest.on_b.point;
    const point3 way{q.x - p.x, q.y - p.y, q.z - p.z};
    if (!base::is_finite(way))
        throw std::overflow_error("treeform::mate: the meshes are too far from each other");
    return way;
}

mate_motion motion_to_mate(const relation_result& nearest, const shape& a,
                           std::span<const shape> parts, const sweep_options& options) {
    mate_motion result;
    if (nearest.relation != mesh_relation::disjoint) return result;
    result.motion = way_between(nearest);
    if (result.motion == point3{}) return result;
    // Nothing is nearer than the nearest point. Corners that are to meet there may miss each other
    // by the rounding of their distance.
    sweep_options rest = options;
    rest.latest = 1.0 + 0x1p-20;
    result.met = sweep_among(a, parts, result.motion, rest);
    result.time = result.met.outcome == placement_outcome::nothing_met
                      ? std::max(0.0, 1.0 - options.clearance / nearest.distance)
                      : result.met.time;
    return result;
}

}  // namespace treeform::detail::place
