#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/effort.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/separation_search.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/time_of_impact.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::plus;
using detail::base::scaled;
using detail::place::length_of;
using detail::place::shape;

/// Where rounding leaves a mesh just inside another, it is out a little further on.
constexpr std::array<double, 5> stretches{1.0, 1.0 + 0x1p-51, 1.0 + 0x1p-48, 1.0 + 0x1p-43,
                                          1.0 + 0x1p-36};

/// A corner of each component of the mesh.
std::vector<point3> corner_of_each_part(mesh_view mesh) {
    const auto component = face_components(mesh.points.size(), mesh.faces);
    std::vector<point3> corners;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        if (component[f] == corners.size()) corners.push_back(mesh.points[mesh.faces[f][0]]);
    return corners;
}

/// Looks for a short translation of `a` out of `b`. Places on the way are judged by their faces,
/// and by a corner of each part; the last one is judged exactly.
class escape_search {
  public:
    escape_search(const shape& a, const shape& b, detail::base::effort& effort,
                  detail::base::work_progress& work)
        : a_(a),
          b_(b),
          effort_(effort),
          work_(work),
          box_a_(bounding_box(a.mesh().points).value()),
          box_b_(bounding_box(b.mesh().points).value()) {
        const auto largest = [](const box3& box) {
            return std::max(detail::base::largest_of(box.min), detail::base::largest_of(box.max));
        };
        least_ = std::max(0x1p-53 * std::max(largest(box_a_), largest(box_b_)),
                          std::numeric_limits<double>::min());
        if (b.closed()) parts_a_ = corner_of_each_part(a.joined());
        if (a.closed()) parts_b_ = corner_of_each_part(b.joined());
    }

    /// Tries the way of this offset, and then all others from it.
    void improve(const point3& start, std::size_t directions) {
        best_ = start;
        length_ = length_of(start);
        // The golden spiral spreads points evenly over the sphere.
        const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
        for (std::size_t i = 0; i < directions; ++i) {
            const double n = static_cast<double>(i) + 0.5;
            const double z = 1.0 - 2.0 * n / static_cast<double>(directions);
            const double r = std::sqrt(1.0 - z * z), at = turn * n;
            if (!may_continue(0.4 + 0.2 * n / static_cast<double>(directions))) return;
            look({r * std::cos(at), r * std::sin(at), z});
        }
        refine();
    }

    /// The shortest offset found that stands the exact judgment, stepped out a little where
    /// rounding asks for it; `verified`, which has stood it, where none does.
    [[nodiscard]] point3 settled(const point3& verified) {
        const double limit = length_of(verified);
        for (auto found = ways_.rbegin(); found != ways_.rend() && !work_.cancelled(); ++found)
            for (const double stretch : stretches) {
                const point3 offset = scaled(*found, stretch);
                if (length_of(offset) < limit && is_out(offset)) return offset;
            }
        return verified;
    }

    /// Exactly, on the coordinates as moved; false, too, where that takes too much effort.
    [[nodiscard]] bool is_out(const point3& offset) {
        std::vector<point3> points(a_.mesh().points.begin(), a_.mesh().points.end());
        for (point3& p : points) p = plus(p, offset);
        const mesh_view there{points, a_.mesh().faces};
        const tree<3> faces = build_face_tree(there);
        const auto how = detail::place::relation_of(
            shape(a_.prepared(), points, faces, a_.vertices()), b_, {}, &effort_);
        return how.status == status::ok && how.relation != mesh_relation::penetrating;
    }

  private:
    [[nodiscard]] bool may_continue(double done) { return work_.reach(done) && !effort_.spent(); }

    [[nodiscard]] static bool any_inside(const std::vector<point3>& corners, const point3& by,
                                         const shape& solid, const box3& box) {
        const detail::intersect::point_locator in(solid.joined(), solid.faces());
        for (const point3& corner : corners) {
            const point3 p = plus(corner, by);
            bool within = true;
            for (std::size_t k = 0; k < 3; ++k)
                within = within && box.min[k] < p[k] && p[k] < box.max[k];
            if (within && in.locate(p).where == location::inside) return true;
        }
        return false;
    }

    [[nodiscard]] bool seems_out(const point3& offset) {
        bool apart = false;
        for (std::size_t k = 0; k < 3; ++k)
            apart = apart || box_a_.min[k] + offset[k] > box_b_.max[k] ||
                    box_a_.max[k] + offset[k] < box_b_.min[k];
        if (apart) return true;
        face_pair_options options;
        options.transform_a = transform<3>::translation(offset);
        options.first_only = true;
        options.kinds = pair_kind::crossing;
        const auto found = detail::intersect::mesh_intersections(a_.mesh(), a_.faces(), b_.mesh(),
                                                                 b_.faces(), options, &effort_);
        if (!found.pairs.empty() || found.status == treeform::status::cancelled) return false;
        return !any_inside(parts_a_, offset, b_, box_b_) &&
               !any_inside(parts_b_, scaled(offset, -1.0), a_, box_a_);
    }

    /// Whether this direction, of length 1, leads out sooner; then it is the best.
    bool look(const point3& direction) {
        // A little less than the best, or steps without end would be taken on one plane.
        const point3 offset = scaled(direction, length_ * (1.0 - 0x1p-30));
        if (!seems_out(offset)) return false;
        const double out = length_ * (1.0 - 0x1p-30);
        impact_options options;
        options.transform_a = transform<3>::translation(offset);
        options.latest = out;
        options.limit = 1;
        const impact back = detail::place::impact_of(a_.mesh(), a_.faces(), b_.mesh(), b_.faces(),
                                                     scaled(direction, -1.0), options, &effort_);
        if (back.status == status::cancelled) return false;
        const double time =
            std::max(back.outcome == placement_outcome::contact ? out - back.time : out, least_);
        if (!(time < length_)) return false;
        best_ = scaled(direction, time);
        length_ = time;
        ways_.push_back(best_);
        return true;
    }

    /// Turns the way by less and less, as long as that makes it shorter.
    void refine() {
        int step = 0;
        for (double tilt = 0.5; tilt > 1e-6; tilt *= 0.6) {
            if (!may_continue(0.6 + 0.3 * static_cast<double>(++step) / 26.0)) return;
            for (int again = 0; again < 8 && look_around(tilt); ++again) continue;
        }
    }

    bool look_around(double tilt) {
        const point3 d = scaled(best_, 1.0 / length_);
        point3 axis{};
        axis[std::abs(d.x) > std::abs(d.y) ? 1 : 0] = 1.0;
        point3 u = cross(d, axis);
        u = scaled(u, 1.0 / length_of(u));
        const point3 v = cross(d, u);
        bool better = false;
        for (int i = 0; i < 8; ++i) {
            const double at = 0.25 * std::numbers::pi * static_cast<double>(i);
            const point3 aside = plus(scaled(u, std::cos(at)), scaled(v, std::sin(at)));
            const point3 turned = plus(d, scaled(aside, tilt));
            better = look(scaled(turned, 1.0 / length_of(turned))) || better;
        }
        return better;
    }

    const shape& a_;
    const shape& b_;
    detail::base::effort& effort_;
    detail::base::work_progress& work_;
    box3 box_a_, box_b_;
    std::vector<point3> parts_a_, parts_b_;
    point3 best_{};
    double length_ = 0.0;
    double least_ = 0.0;        ///< shorter moves are lost in the rounding of the coordinates
    std::vector<point3> ways_;  ///< each shorter than the one before
};

}  // namespace

std::optional<penetration_depth_result> penetration_depth(const mesh_ref& given_a,
                                                          const mesh_ref& given_b,
                                                          const measure_options& options) {
    const detail::base::prepared_ref a(given_a);
    const detail::base::prepared_ref b(given_b);
    detail::place::check_operand("penetration_depth", "a", a);
    detail::place::check_operand("penetration_depth", "b", b);
    if (a.is_cloud() || b.is_cloud() || a.view().faces.empty() || b.view().faces.empty())
        return std::nullopt;
    detail::base::work_progress work(options.progress);
    const penetration_depth_result stopped{.status = status::cancelled};
    const shape of_a(a, options.vertices), of_b(b, options.vertices);
    const auto how = detail::place::relation_of(of_a, of_b, work.part(0.0, 0.1));
    if (how.status == status::cancelled) return stopped;
    if (how.relation != mesh_relation::penetrating) return std::nullopt;
    detail::base::effort effort(options.effort, a.view().faces.size() + b.view().faces.size());
    effort.hold(0.5);  // for the judgments, and for what shortens the way
    const auto found = detail::place::search_separations(
        of_a, {&of_b, 1}, {.effort = &effort, .progress = work.part(0.1, 0.4)});
    if (work.cancelled()) return stopped;
    escape_search search(of_a, of_b, effort, work);
    effort.hold(0.375);
    // The first that is out exactly: rounding may have put one back in.
    std::optional<point3> verified;
    for (const auto& move : found.moves)
        for (const double stretch : stretches) {
            const point3 offset = scaled(move.direction, move.time * stretch);
            if (!verified && search.is_out(offset)) verified = offset;
        }
    if (!verified)
        return penetration_depth_result{.effort = effort.so_far(), .status = status::no_placement};
    effort.hold(0.125);
    search.improve(*verified, options.directions);
    effort.hold(0.0);
    const point3 move = search.settled(*verified);
    if (work.cancelled()) return stopped;
    work.reach(1.0);
    return penetration_depth_result{
        .depth = length_of(move), .move = move, .effort = effort.so_far()};
}

}  // namespace treeform
