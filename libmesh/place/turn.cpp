#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/surroundings.hpp>
#include <libmesh/place/turn_motion.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::place::search_turn;
using detail::place::shape;
using detail::place::turn_search;
using detail::place::unit_axis;

constexpr double degrees_of_radian = 180.0 / std::numbers::pi;
constexpr unsigned most_steps_back = 60;

void check(const point3& origin, const point3& direction, const placement_options& o) {
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("treeform::turn: ") + what);
    };
    if (!detail::base::is_finite(direction) || direction == point3{})
        refuse("the axis is zero or not finite");
    if (!detail::base::is_finite(origin)) refuse("the origin of the axis is not finite");
    if (!(o.clearance >= 0.0) || !std::isfinite(o.clearance))
        refuse("the clearance is negative or not finite");
    if (!(o.max_angle > 0.0 && o.max_angle <= 360.0))
        refuse("the largest angle is not in (0, 360]");
    if (o.tolerance && !(*o.tolerance > 0.0 && std::isfinite(*o.tolerance)))
        refuse("the tolerance is not positive or not finite");
}

class turning {
  public:
    turning(const prepared_mesh& moving, std::span<const prepared_mesh> fixed,
            const unit_axis& axis, const placement_options& options)
        : moving_(moving),
          fixed_(fixed),
          axis_(axis),
          options_(options),
          work_(options_.progress) {}

    [[nodiscard]] placement run() {
        result_ = measured(moving_, 0.0, 0.2);
        if (cancelled() || moving_.indexed_view().faces.empty())
            return ended(placement_outcome::nothing_met);
        const mesh_relation start = result_.relation;
        if (start == mesh_relation::penetrating)
            return ended(placement_outcome::starts_penetrating);
        if (start == mesh_relation::closer_than_clearance)
            return ended(placement_outcome::starts_too_near);
        if (start == mesh_relation::touching && options_.clearance > 0.0)
            return ended(placement_outcome::starts_touching);
        if (start == mesh_relation::touching) return settle(0.0, placement_outcome::unchanged);
        return search();
    }

  private:
    [[nodiscard]] bool cancelled() const { return work_.cancelled(); }

    [[nodiscard]] placement measured(const prepared_mesh& mesh, double begin, double end) {
        placement_options options = options_;
        options.progress = work_.part(begin, end);
        return measure_in_place(mesh, fixed_, options);
    }

    [[nodiscard]] placement search() {
        const auto ring = detail::place::ring_of(moving_.indexed_view(), axis_);
        result_.tolerance = options_.tolerance.value_or(ring.radius * 0x1p-32);
        const detail::place::surroundings among(fixed_, options_.vertices);
        const auto near = among.around(ring.box, options_.clearance);
        result_.statistics.fixed_culled = among.size() - near.parts.size();
        if (near.parts.empty() || !(ring.radius > 0.0))
            return ended(placement_outcome::nothing_met);
        turn_search found = search_turn(shape(moving_, options_.vertices), near.parts, axis_,
                                        {.clearance = options_.clearance,
                                         .tolerance = result_.tolerance,
                                         .radius = ring.radius,
                                         .latest = options_.max_angle / degrees_of_radian,
                                         .max_steps = options_.max_steps,
                                         .limit = options_.limit,
                                         .progress = work_.part(0.2, 0.8)});
        result_.statistics.steps = found.steps;
        result_.statistics.pairs_tested = found.pairs;
        if (found.outcome == turn_search::end_of::gave_up)
            return ended(placement_outcome::too_many_steps);
        if (found.outcome != turn_search::end_of::met) return ended(placement_outcome::nothing_met);
        for (placement_contact& c : found.contacts) c.fixed = near.number[c.fixed];
        contacts_ = std::move(found.contacts);
        return settle(found.angle, placement_outcome::contact);
    }

    [[nodiscard]] std::vector<point3> points_at(const transform<3>& there) const {
        std::vector<point3> points(moving_.indexed_view().points.begin(),
                                   moving_.indexed_view().points.end());
        for (point3& p : points) {
            p = there(p);
            if (options_.precision == precision::float32)
                for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
        }
        return points;
    }

    [[nodiscard]] bool good(const placement& there) const {
        return there.relation == mesh_relation::clear ||
               (!(options_.clearance > 0.0) && there.relation != mesh_relation::penetrating &&
                there.relation != mesh_relation::closer_than_clearance);
    }

    /// At the angle, or the first before it that is good in coordinates to be written.
    [[nodiscard]] placement settle(double angle, placement_outcome end) {
        double unit = 0.0;
        for (unsigned tries = 0; tries < most_steps_back && !cancelled(); ++tries) {
            const double at = std::max(0.0, angle - unit);
            const transform<3> there = axis_.by(at);
            std::vector<point3> points = points_at(there);
            if (!detail::base::all_finite(points)) return ended(placement_outcome::out_of_range);
            const prepared_mesh written =
                prepared_mesh::borrow({points, mesh_ref(moving_).view().faces});
            placement now = measured(written, 0.8, 1.0);
            if (good(now)) {
                accept(std::move(now), std::move(points), there, at, end);
                result_.statistics.backed_off = tries;
                return std::move(result_);
            }
            if (at == 0.0) break;  // where it came from
            unit = unit == 0.0 ? unit_of(points) : 2.0 * unit;
        }
        return ended(placement_outcome::not_representable);
    }

    /// The angle that moves the largest coordinate by about a unit in its last place.
    [[nodiscard]] double unit_of(const std::vector<point3>& points) const {
        double largest = 0.0, radius = 0.0;
        for (const point3& p : points) {
            largest = std::max(largest, detail::base::largest_of(p));
            radius = std::max(radius, detail::base::largest_of(axis_.across(p)));
        }
        const double last = options_.precision == precision::float32 ? 0x1p-24 : 0x1p-53;
        return radius > 0.0 ? largest * last / radius : last;
    }

    void accept(placement&& now, std::vector<point3>&& points, const transform<3>& there, double at,
                placement_outcome end) {
        now.relation_at_start = result_.relation_at_start;
        now.statistics = result_.statistics;
        now.outcome = end;
        now.matrix = there;
        now.certificate.precision = options_.precision;
        now.certificate.max_displacement =
            detail::max_displacement(moving_.indexed_view().points, there, points);
        now.points = std::move(points);
        if (now.contacts.empty()) {
            now.contacts = std::move(contacts_);
            now.contact_count = now.contacts.size();
        }
        now.angle = at * degrees_of_radian;
        now.tolerance = result_.tolerance;
        result_ = std::move(now);
    }

    /// No place, or cancelled.
    [[nodiscard]] placement ended(placement_outcome end) {
        result_.outcome = cancelled() ? placement_outcome::cancelled : end;
        result_.certificate.precision = options_.precision;
        result_.certificate.status = cancelled() ? status::cancelled
                                     : end == placement_outcome::out_of_range
                                         ? status::out_of_range
                                         : status::no_placement;
        return std::move(result_);
    }

    const prepared_mesh& moving_;
    std::span<const prepared_mesh> fixed_;
    unit_axis axis_;
    placement_options options_;
    detail::base::work_progress work_;
    std::vector<placement_contact> contacts_;
    placement result_{};
};

}  // namespace

placement turn(const mesh_ref& given_moving, const mesh_refs& given_fixed, const point3& origin,
               const point3& direction, const placement_options& options) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    check(origin, direction, options);
    detail::place::check_operand("turn", "moving", moving.view());
    for (std::size_t i = 0; i < fixed.size(); ++i)
        detail::place::check_operand("turn", "fixed " + std::to_string(i), fixed[i].indexed_view());
    return turning(moving, fixed, {origin, direction}, options).run();
}

}  // namespace treeform
