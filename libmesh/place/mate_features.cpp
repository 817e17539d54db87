#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/turn_motion.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::minus;
using detail::base::plus;
using detail::base::scaled;

void check(const mesh_feature& a, const mesh_feature& b) {
    const auto refuse = [](const char* what) {
        throw std::invalid_argument(std::string("treeform::mate_features: ") + what);
    };
    if (a.kind != b.kind) refuse("of_fixed and of_moving are of different kinds");
    for (const mesh_feature* f : {&a, &b}) {
        if (!detail::base::is_finite(f->origin)) refuse("the origin of a feature is not finite");
        if (!(std::abs(dot(f->direction, f->direction) - 1.0) < 1e-6))
            refuse("the direction of a feature is not of length 1");
    }
}

/// The least rotation that turns direction `a` to `b`, and its angle in radians.
std::pair<transform<3>, double> turn_between(const point3& a, const point3& b) {
    if (a == b) return {{}, 0.0};
    const point3 n = cross(a, b);
    const double sine = std::sqrt(dot(n, n)), cosine = dot(a, b);
    // Opposite ones: about any line across.
    point3 axis = n;
    if (!(sine > 1e-12)) {
        if (cosine > 0.0 && sine == 0.0) return {{}, 0.0};
        const point3 other = std::abs(a.x) < 0.6 ? point3{1, 0, 0} : point3{0, 1, 0};
        if (cosine < 0.0) axis = cross(a, other);
    }
    const double angle = std::atan2(sine, cosine);
    return {detail::place::unit_axis({}, axis).by(angle), angle};
}

/// `first`, then what takes the point `from` to `to`.
transform<3> carried(transform<3> first, const point3& from, const point3& to) {
    const point3 there = first(from);
    for (std::size_t k = 0; k < 3; ++k) first.rows[k][3] += to[k] - there[k];
    return first;
}

class feature_mover {
  public:
    feature_mover(const prepared_mesh& moving, std::span<const prepared_mesh> fixed,
                  const mesh_feature& from, const mesh_feature& to,
                  const placement_options& options)
        : moving_(moving),
          fixed_(fixed),
          from_(from),
          to_(to),
          options_(options),
          work_(options_.progress) {}

    [[nodiscard]] placement run() {
        const placement start = measured(moving_, 0.0, 0.1);
        if (work_.cancelled()) return start;
        const bool plane = from_.kind == feature_kind::plane;
        const bool alike = dot(from_.direction, to_.direction) >= 0.0;
        const double sign =
            plane ? (options_.flip ? 1.0 : -1.0) : (alike != options_.flip ? 1.0 : -1.0);
        const auto [turn, angle] = turn_between(from_.direction, scaled(to_.direction, sign));
        const transform<3> seat = carried(turn, from_.origin, to_.origin);

        // From where it comes: a plane from before the other, an axis from its own side.
        const bool before = plane || dot(minus(from_.origin, to_.origin), to_.direction) >= 0.0;
        const point3 out = scaled(to_.direction, before ? 1.0 : -1.0);
        const transform<3> away =
            carried(seat, from_.origin, plus(to_.origin, scaled(out, pulled_out(seat, out))));
        placement result = slid(away, out);
        if (result.outcome == placement_outcome::nothing_met && !plane) result = seated(seat);
        result.relation_at_start = start.relation_at_start;
        result.travel = 0.0;
        result.direction = {};
        result.angle = angle * 180.0 / std::numbers::pi;
        if (result)
            result.offset = dot(minus(result.matrix(from_.origin), to_.origin), to_.direction);
        return result;
    }

  private:
    [[nodiscard]] placement measured(const prepared_mesh& mesh, double begin, double end) {
        placement_options options = options_;
        options.progress = work_.part(begin, end);
        return measure_in_place(mesh, fixed_, options);
    }

    [[nodiscard]] mesh moved(const transform<3>& by) const {
        const mesh_view here = mesh_ref(moving_).view();  // a cloud stays one
        mesh there{{here.points.begin(), here.points.end()},
                   {here.faces.begin(), here.faces.end()}};
        for (point3& p : there.points) {
            if (by != transform<3>{}) p = by(p);
            if (options_.precision == precision::float32)
                for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
        }
        return there;
    }

    /// How far to pull the seated mesh out, along `out`, until it is apart from all that is fixed.
    [[nodiscard]] double pulled_out(const transform<3>& seat, const point3& out) const {
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, size = 0.0;
        for (const face& f : moving_.indexed_view().faces)
            for (const std::uint32_t i : f) {
                const double along = dot(seat(moving_.indexed_view().points[i]), out);
                lowest = std::min(lowest, along);
                size = std::max(size, std::abs(along));
            }
        for (const prepared_mesh& one : fixed_)
            for (const face& f : one.indexed_view().faces)
                for (const std::uint32_t i : f) {
                    const double along = dot(one.indexed_view().points[i], out);
                    highest = std::max(highest, along);
                    size = std::max(size, std::abs(along));
                }
        const double distance = highest - lowest + 2.0 * options_.clearance + size * 0x1p-10;
        return std::isfinite(distance) ? std::max(0.0, distance) : 0.0;
    }

    /// Slid from there against `out`; the move of all of it in `matrix`.
    [[nodiscard]] placement slid(const transform<3>& from, const point3& out) {
        const prepared_mesh there(moved(from));
        placement at = slide(there, fixed_, scaled(out, -1.0),
                             {.clearance = options_.clearance,
                              .precision = options_.precision,
                              .limit = options_.limit,
                              .vertices = options_.vertices,
                              .progress = work_.part(0.1, 0.8)});
        if (at) {
            at.matrix = at.matrix.after(from);
            at.certificate.max_displacement =
                detail::max_displacement(moving_.indexed_view().points, at.matrix, at.points);
        } else {
            at.points.assign(moving_.indexed_view().points.begin(),
                             moving_.indexed_view().points.end());
        }
        return at;
    }

    /// Where the centers agree, if it may be there.
    [[nodiscard]] placement seated(const transform<3>& seat) {
        mesh there = moved(seat);
        std::vector<point3> points = there.points;
        const prepared_mesh shape(std::move(there));
        placement at = measured(shape, 0.8, 1.0);
        if (work_.cancelled()) return at;
        const bool near = options_.clearance > 0.0 && at.relation != mesh_relation::clear;
        at.certificate.precision = options_.precision;
        if (at.relation == mesh_relation::penetrating || near) {
            at.outcome =
                near ? placement_outcome::starts_too_near : placement_outcome::starts_penetrating;
            at.certificate.status = status::no_placement;
            at.points.assign(moving_.indexed_view().points.begin(),
                             moving_.indexed_view().points.end());
            return at;
        }
        at.outcome = placement_outcome::unchanged;
        at.matrix = seat;
        at.certificate.max_displacement =
            detail::max_displacement(moving_.indexed_view().points, seat, points);
        at.points = std::move(points);
        return at;
    }

    const prepared_mesh& moving_;
    std::span<const prepared_mesh> fixed_;
    const mesh_feature& from_;
    const mesh_feature& to_;
    placement_options options_;
    detail::base::work_progress work_;
};

}  // namespace

placement mate_features(const mesh_ref& given_moving, const mesh_refs& given_fixed,
                        const mesh_feature& of_moving, const mesh_feature& of_fixed,
                        const placement_options& options) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    check(of_moving, of_fixed);
    detail::place::check_operand("mate_features", "moving", moving.view());
    for (std::size_t i = 0; i < fixed.size(); ++i)
        detail::place::check_operand("mate_features", "fixed " + std::to_string(i),
                                     fixed[i].indexed_view());
    if (!(options.clearance >= 0.0) || !std::isfinite(options.clearance))
        throw std::invalid_argument(
            "treeform::mate_features: the clearance is negative or not finite");
    return feature_mover(moving, fixed, of_moving, of_fixed, options).run();
}

}  // namespace treeform
