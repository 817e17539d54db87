#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/detail/bounded_sweep.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using detail::base::triangle_of;

triangle3 moved(triangle3 t, const point3& motion, double time) {
    for (point3& p : t)
        for (std::size_t k = 0; k < 3; ++k) p[k] += time * motion[k];
    return t;
}

/// Two faces, one of them in motion.
struct moving_pair {
    triangle3 a, b;
    point3 motion;

    /// The first time at which they are not further apart than `level`; none before `latest`.
    [[nodiscard]] std::optional<double> time_within(double level, double latest) const {
        double time = 0.0;
        for (int step = 0; step < 200; ++step) {
            const auto at = closest_pair(moved(a, motion, time), b);
            const double apart = std::sqrt(at.squared_distance);
            if (apart <= level) return time;
            double slope = 0.0;
            for (std::size_t k = 0; k < 3; ++k)
                slope += (at.on_a[k] - at.on_b[k]) / apart * motion[k];
            if (!(slope < 0.0)) return std::nullopt;  // convex: it will not come nearer
            const double next = time + (apart - level) / -slope;
            if (!(next <= latest)) return std::nullopt;
            if (!(next > time)) return time;
            time = next;
        }
        return time;
    }

    /// What the rounding of coordinates and distances may come to.
    [[nodiscard]] double slack(double distance) const {
        double largest = distance;
        for (const triangle3* t : {&a, &b})
            for (const point3& p : *t)
                for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
        return largest * 0x1p-48;
    }
};

tree<3> widened_tree(mesh_view mesh, double by) {
    return build(mesh.faces, [&](const face& f) {
        aabb<double, 3> box;
        for (const std::uint32_t corner : f) box.include(mesh.points[corner]);
        constexpr double most = std::numeric_limits<double>::max();  // trees have finite boxes
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::nextafter(std::max(box.min[k] - by, -most), -most);
            box.max[k] = std::nextafter(std::min(box.max[k] + by, most), most);
        }
        return box;
    });
}

using pair_of_faces = std::pair<std::uint32_t, std::uint32_t>;

prepared_mesh moved_by(const transform<3>& by, const prepared_mesh& mesh) {
    const mesh_view from = mesh_ref(mesh).view();  // a cloud stays one
    treeform::mesh there{{from.points.begin(), from.points.end()},
                         {from.faces.begin(), from.faces.end()}};
    for (point3& p : there.points) p = by(p);
    return prepared_mesh(std::move(there));
}

triangle3 moved_triangle(mesh_view mesh, std::uint32_t face, const transform<3>& by, bool moves) {
    triangle3 t;
    for (std::size_t i = 0; i < 3; ++i) {
        const point3& p = mesh.points[mesh.faces[face][i]];
        t[i] = moves ? by(p) : p;
    }
    return t;
}

/// The pairs of faces with the least time so far.
struct earliest {
    struct pair {
        std::uint32_t a, b;
        feature_pair at;
    };
    std::optional<sweep_contact> first;
    std::vector<pair> pairs;

    void offer(const point3& motion, std::uint32_t a, std::uint32_t b, const sweep_contact& one,
               predicate_counters& counters) {
        const int order = first ? compare(motion, one, *first, &counters) : -1;
        if (order > 0) return;
        if (order < 0) pairs.clear();
        pairs.push_back({a, b, one.at});
        // Of equal times, which plane stands for them depends on no order of search.
        if (order < 0 || std::pair(a, b) < lowest_) {
            first = one;
            lowest_ = {a, b};
        }
    }

  private:
    std::pair<std::uint32_t, std::uint32_t> lowest_{};
};

/// The first `limit` pairs of faces that meet at the time of the result.
template <class FaceA, class FaceB>
void enter_contacts(std::vector<earliest::pair>& pairs, const point3& motion, std::size_t limit,
                    const FaceA& face_a, const FaceB& face_b, impact& result) {
    result.contact_count = pairs.size();
    std::sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
        return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
    pairs.resize(std::min(pairs.size(), limit));
    for (const auto& pair : pairs) {
        const triangle3 there = moved(face_a(pair.a), motion, result.time);
        result.contacts.push_back(
            {pair.a, pair.b, pair.at, closest_pair(there, face_b(pair.b)).on_b});
    }
}

/// None where the effort does not suffice to say.
std::optional<bool> meets_at_start(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                   const tree<3>& tree_b, const impact_options& options,
                                   detail::base::effort* effort) {
    if (!effort)
        return detail::intersect::intersects(a, tree_a, b, tree_b,
                                             {options.transform_a, options.transform_b});
    const auto first = detail::intersect::mesh_intersections(a, tree_a, b, tree_b,
                                                             {.transform_a = options.transform_a,
                                                              .transform_b = options.transform_b,
                                                              .first_only = true},
                                                             effort);
    if (first.status == treeform::status::cancelled) return std::nullopt;
    return !first.pairs.empty();
}

}  // namespace

impact detail::place::approach_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                  const tree<3>& tree_b, const point3& motion, double distance,
                                  const impact_options& options, base::effort* effort) {
    if (!(distance > 0.0) || !std::isfinite(distance))
        throw std::invalid_argument(
            "treeform::time_to_distance: the distance is not positive or infinite");
    if (!(options.latest >= 0.0))
        throw std::invalid_argument(
            "treeform::time_to_distance: the latest time is negative or NaN");
    impact result;
    const auto near = detail::nearness::closest_pair(a, tree_a, b, tree_b, distance);
    detail::base::work_progress work(options.progress);
    if (near && near->distance < distance) {
        result.outcome = placement_outcome::starts_touching;
        result.time = 0.0;
        work.reach(1.0);
        return result;
    }
    if (!work.reach(0.4)) return {.status = status::cancelled};
    const auto may_continue = [&, usual = static_cast<double>(a.faces.size() + b.faces.size())] {
        return result.pairs_tested % 1024 != 0 || work.step(0.4, 0.9, result.pairs_tested, usual);
    };
    const std::uint64_t most = effort ? effort->allowance() / base::effort::in_motion
                                      : std::numeric_limits<std::uint64_t>::max();
    double latest = options.latest;
    std::vector<pair_of_faces> pairs;
    const tree<3> wide = widened_tree(a, distance);
    const std::uint64_t opened = detail::sweep_within<3>(
        wide, tree_b, {motion.x, motion.y, motion.z}, options.latest, most,
        [&](std::uint32_t i, std::uint32_t j) {
            ++result.pairs_tested;
            if (!may_continue() || result.pairs_tested > most) return -1.0;
            const moving_pair pair{triangle_of(a, i), triangle_of(b, j), motion};
            const double below = std::max(0.0, distance - pair.slack(distance));
            const auto time = pair.time_within(distance, latest);
            if (!time || !pair.time_within(below, std::numeric_limits<double>::infinity()))
                return latest;
            if (pairs.empty() || *time < result.time) pairs.clear();
            result.time = *time;
            latest = *time;
            pairs.emplace_back(i, j);
            return latest;
        });
    if (effort && !effort->spend((result.pairs_tested + opened) * base::effort::in_motion))
        return {.status = status::cancelled};
    if (work.cancelled() || !work.reach(1.0)) return {.status = status::cancelled};
    if (pairs.empty()) return result;

    result.outcome = placement_outcome::contact;
    result.contact_count = pairs.size();
    std::sort(pairs.begin(), pairs.end());
    pairs.resize(std::min(pairs.size(), options.limit));
    for (const auto& [i, j] : pairs)
        result.contacts.push_back(
            {i,
             j,
             {triangle_feature::v0, triangle_feature::v0},
             closest_pair(moved(triangle_of(a, i), motion, result.time), triangle_of(b, j)).on_b});
    return result;
}

impact time_to_distance(const mesh_ref& given_a, const mesh_ref& given_b, const point3& motion,
                        double distance, const impact_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    if (options.transform_a != transform<3>{} || options.transform_b != transform<3>{}) {
        impact_options there = options;
        there.transform_a = there.transform_b = {};
        return time_to_distance(moved_by(options.transform_a, a), moved_by(options.transform_b, b),
                                motion, distance, there);
    }
    detail::place::check_operand("time_to_distance", "a", a);
    detail::place::check_operand("time_to_distance", "b", b);
    detail::place::check_motion("time_to_distance", motion);
    return detail::place::approach_of(a.view(), build_face_tree(a), b.view(), build_face_tree(b),
                                      motion, distance, options);
}

double detail::place::time_not_beyond(const sweep_contact& contact, const point3& motion) {
    const auto beyond = [&](double time) {
        return compare_cut(contact.from, motion, contact.until, time) < 0;
    };
    constexpr double largest = std::numeric_limits<double>::max();
    // The rounded time is off by at most 2^-40 of the exact one, or by a few denormals.
    double low = std::clamp(contact.time * (1.0 - 0x1p-39) - 0x1p-1060, 0.0, largest);
    double high = std::min(contact.time * (1.0 + 0x1p-39) + 0x1p-1060, largest);
    if (!beyond(high)) return high;
    if (beyond(low)) low = 0.0;
    while (true) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return low;
        (beyond(middle) ? high : low) = middle;
    }
}

impact detail::place::impact_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                const tree<3>& tree_b, const point3& motion,
                                const impact_options& options, base::effort* effort,
                                sweep_contact* exact) {
    impact result;
    if (!(options.latest >= 0.0))
        throw std::invalid_argument("treeform::time_of_impact: the latest time is negative or NaN");
    detail::base::work_progress work(options.progress);
    const auto meets = meets_at_start(a, tree_a, b, tree_b, options, effort);
    if (!meets) return {.status = status::cancelled};
    if (*meets) {
        result.outcome = placement_outcome::starts_touching;
        result.time = 0.0;
        work.reach(1.0);
        return result;
    }
    if (!work.reach(0.4)) return {.status = status::cancelled};
    const auto may_continue = [&, usual = static_cast<double>(a.faces.size() + b.faces.size())] {
        return result.pairs_tested % 1024 != 0 || work.step(0.4, 0.9, result.pairs_tested, usual);
    };
    const std::uint64_t most = effort ? effort->allowance() / base::effort::in_motion
                                      : std::numeric_limits<std::uint64_t>::max();
    const transformed<3> moving(tree_a, options.transform_a);
    const transformed<3> still(tree_b, options.transform_b);
    const auto face_a = [&](std::uint32_t f) {
        return moved_triangle(a, f, options.transform_a, moving.is_moved());
    };
    const auto face_b = [&](std::uint32_t f) {
        return moved_triangle(b, f, options.transform_b, still.is_moved());
    };

    earliest found;
    const std::uint64_t opened = detail::sweep_within<3>(
        moving, still, {motion.x, motion.y, motion.z}, options.latest, most,
        [&](std::uint32_t i, std::uint32_t j) {
            ++result.pairs_tested;
            if (!may_continue() || result.pairs_tested > most) return -1.0;
            if (const auto one = first_contact(face_a(i), face_b(j), motion, &result.predicates))
                found.offer(motion, i, j, *one, result.predicates);
            return found.first ? found.first->time * (1.0 + 0x1p-38) : options.latest;
        });
    if (effort && !effort->spend((result.pairs_tested + opened) * base::effort::in_motion))
        return {.status = status::cancelled};
    if (work.cancelled() || !work.reach(1.0)) return {.status = status::cancelled};
    if (!found.first) return result;
    if (std::isfinite(options.latest) &&
        compare_cut(found.first->from, motion, found.first->until, options.latest) > 0)
        return result;

    result.outcome = placement_outcome::contact;
    if (exact != nullptr) *exact = *found.first;
    result.time = time_not_beyond(*found.first, motion);
    enter_contacts(found.pairs, motion, options.limit, face_a, face_b, result);
    return result;
}

impact time_of_impact(const mesh_ref& given_a, const mesh_ref& given_b, const point3& motion,
                      const impact_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    detail::place::check_operand("time_of_impact", "a", a);
    detail::place::check_operand("time_of_impact", "b", b);
    detail::place::check_motion("time_of_impact", motion);
    return detail::place::impact_of(a.view(), build_face_tree(a), b.view(), build_face_tree(b),
                                    motion, options);
}

}  // namespace treeform
