#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/facing.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/separation_search.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace treeform::detail::place {
namespace {

using base::cross;
using base::dot;
using base::plus;
using base::scaled;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of length 1; none of a vector too short to have a direction.
std::optional<point3> direction_of(point3 v) {
    const double largest = base::largest_of(v);
    if (!(largest > 0.0) || !std::isfinite(largest)) return std::nullopt;
    v = {v.x / largest, v.y / largest, v.z / largest};
    const double length = std::sqrt(dot(v, v));
    return point3{v.x / length, v.y / length, v.z / length};
}

std::optional<point3> normal_of(mesh_view mesh, std::uint32_t f) {
    const face& corners = mesh.faces[f];
    const point3 &p = mesh.points[corners[0]], &q = mesh.points[corners[1]],
                 &r = mesh.points[corners[2]];
    const point3 u{q.x - p.x, q.y - p.y, q.z - p.z}, v{r.x - p.x, r.y - p.y, r.z - p.z};
    return direction_of(cross(u, v));
}

class clearing {
  public:
    clearing(const shape& a, std::span<const shape> parts, const apart_options& options)
        : shape_(a),
          a_(a.mesh()),
          tree_(a.faces()),
          options_(options),
          work_(options_.progress),
          box_(bounding_box(a_.points)) {
        for (const shape& part : parts) {
            const auto box = bounding_box(part.mesh().points);
            if (!box || part.mesh().faces.empty()) continue;
            parts_.push_back(part);
            boxes_.push_back(*box);
        }
    }

    [[nodiscard]] separations moves() {
        std::vector<separation> found;
        const bool stays = a_.faces.empty() || !box_ || is_clear({});
        if (!stays && !work_.cancelled()) found = moves_out();
        work_.reach(1.0);
        if (work_.cancelled()) return {.status = status::cancelled};
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& x, const auto& y) { return x.time < y.time; });
        return {.moves = std::move(found)};
    }

  private:
    [[nodiscard]] std::vector<separation> moves_out() {
        std::vector<separation> found;
        const auto pair = nearest({});
        const double lacking = pair ? options_.clearance - pair->distance : 0.0;
        separation best{{}, infinity};
        const auto look = [&](const std::optional<point3>& direction) {
            ++looked_;
            if (!direction || !may_continue()) return;
            const auto time = time_to_leave(*direction, lacking, best.time);
            if (!time) return;
            found.push_back({*direction, *time});
            if (*time < best.time) best = found.back();
        };
        for (const point3& direction : directions()) look(direction);
        for (const double tilt : {0.5, 0.25, 0.125, 0.0625})
            for (const point3& aside : around(best.direction))
                look(direction_of(plus(best.direction, scaled(aside, tilt))));
        if (!options_.effort) return found;
        for (const point3& axis : axes())
            if (const double out = past_all(axis) * (1.0 + 0x1p-10); std::isfinite(out))
                found.push_back({axis, out});
        return found;
    }

    /// Asked of each place: the share is that of the directions, of which some fifty are looked at.
    bool may_continue() { return work_.step(0.0, 0.95, looked_, 25.0); }

    [[nodiscard]] static std::array<point3, 6> axes() {
        return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    }

    /// Six directions at right angles to one.
    [[nodiscard]] static std::vector<point3> around(const point3& d) {
        const std::size_t k = std::abs(d.x) > std::abs(d.y) ? 1 : 0;
        point3 axis{};
        axis[k] = 1.0;
        const auto u = direction_of(cross(d, axis));
        if (!u) return {};
        const point3 v = cross(d, *u);
        const double half = std::sqrt(0.75);
        std::vector<point3> all;
        for (const auto& [x, y] :
             {std::pair(1.0, 0.0), std::pair(0.5, half), std::pair(-0.5, half),
              std::pair(-1.0, 0.0), std::pair(-0.5, -half), std::pair(0.5, -half)})
            all.push_back(plus(scaled(*u, x), scaled(v, y)));
        return all;
    }

    [[nodiscard]] bool boxes_within(std::size_t i, const point3& offset) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = options_.clearance;
            if (!(box_->min[k] + offset[k] - boxes_[i].max[k] <= c &&
                  boxes_[i].min[k] - box_->max[k] - offset[k] <= c))
                return false;
        }
        return true;
    }

    [[nodiscard]] std::vector<point3> points_at(const point3& offset) const {
        std::vector<point3> points(a_.points.begin(), a_.points.end());
        for (point3& p : points) p = plus(p, offset);
        return points;
    }

    /// The nearest pair at the offset within the clearance, over all parts.
    [[nodiscard]] std::optional<closest_pair_result> nearest(const point3& offset) const {
        std::optional<closest_pair_result> best;
        const transformed<3> there(tree_, transform<3>::translation(offset));
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!boxes_within(i, offset)) continue;
            const double radius = best ? best->distance : options_.clearance;
            const auto one =
                nearness::closest_pair(a_, there, parts_[i].mesh(), parts_[i].faces(), radius);
            if (one && (!best || one->distance < best->distance)) best = one;
        }
        return best;
    }

    /// False, too, beyond the range of doubles and when it is to stop.
    [[nodiscard]] bool is_clear(const point3& offset) {
        for (std::size_t k = 0; k < 3; ++k)
            if (!std::isfinite(box_->min[k] + offset[k]) ||
                !std::isfinite(box_->max[k] + offset[k]))
                return false;
        std::vector<std::size_t> close;
        for (std::size_t i = 0; i < parts_.size(); ++i)
            if (boxes_within(i, offset)) close.push_back(i);
        if (close.empty()) return true;
        if (!may_continue()) return false;
        if (options_.clearance > 0.0) {
            const auto pair = nearest(offset);
            if (pair && pair->distance < options_.clearance) return false;
        }
        // What penetrates with its faces is found without a tree for the place.
        const std::vector<point3> points = points_at(offset);
        const mesh_view there{points, a_.faces};
        face_pair_options crossing{.transform_a = transform<3>::translation(offset),
                                   .first_only = true};
        crossing.progress = asking_;
        crossing.kinds = pair_kind::crossing;
        for (const std::size_t i : close) {
            const auto found = intersect::mesh_intersections(
                a_, tree_, parts_[i].mesh(), parts_[i].faces(), crossing, options_.effort);
            if (!found.pairs.empty() || found.status == treeform::status::cancelled) return false;
        }
        const tree<3> faces = build_face_tree(there);
        for (const std::size_t i : close) {
            const auto how =
                relation_of(shape(shape_.prepared(), points, faces, parts_[i].vertices()),
                            parts_[i], asking_, options_.effort);
            if (how.relation == mesh_relation::penetrating || how.status == status::cancelled)
                return false;
        }
        return !work_.cancelled();
    }

    /// So far along `direction` that the box of a part is just left by the clearance.
    [[nodiscard]] double beyond_box(const box3& other, const point3& direction) const {
        double least = infinity;
        for (std::size_t k = 0; k < 3; ++k) {
            if (direction[k] == 0.0) continue;
            const double gap =
                direction[k] > 0.0 ? other.max[k] - box_->min[k] : box_->max[k] - other.min[k];
            least = std::min(least, (gap + options_.clearance) / std::abs(direction[k]));
        }
        return std::max(least, 0.0);
    }

    [[nodiscard]] double past_all(const point3& direction) const {
        double out = 0.0;
        for (const box3& other : boxes_)
            out = std::max(out, beyond_box(other, direction) * (1.0 + 0x1p-20));
        return out;
    }

    /// The length of a free way back from the first free place along `direction`.
    [[nodiscard]] std::optional<double> time_to_leave(const point3& direction, double lacking,
                                                      double best) {
        std::vector<double> times;
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            if (boxes_within(i, {})) times.push_back(beyond_box(boxes_[i], direction));
        const double out = past_all(direction);
        if (!std::isfinite(out)) return std::nullopt;
        for (int k = 12; k >= 0; --k) times.push_back(std::ldexp(out, -k));
        if (lacking > 0.0) times.push_back(lacking * (1.0 + 0x1p-40));
        std::sort(times.begin(), times.end());
        double occupied = 0.0;
        for (const double time : times) {
            if (occupied >= best || work_.cancelled()) return std::nullopt;
            if (is_clear(scaled(direction, time))) return slid_back(direction, time, occupied);
            occupied = time;
        }
        return std::nullopt;
    }

    [[nodiscard]] double slid_back(const point3& direction, double time, double occupied) {
        const std::vector<point3> points = points_at(scaled(direction, time));
        const mesh_view there{points, a_.faces};
        const tree<3> faces = build_face_tree(there);
        const auto back =
            sweep_among(shape(shape_.prepared(), points, faces), parts_, scaled(direction, -1.0),
                        {.clearance = options_.clearance,
                         .latest = time - occupied,
                         .limit = 1,
                         .effort = options_.effort,
                         .progress = asking_});
        return back.outcome == placement_outcome::contact ? time - back.time : time;
    }

    [[nodiscard]] std::vector<point3> directions() {
        std::vector<point3> found;
        const auto offer = [&](const std::optional<point3>& d) {
            if (!d) return;
            for (const point3& known : found)
                if (dot(known, *d) > 1.0 - 0x1p-30) return;
            found.push_back(*d);
        };
        for (const point3& axis : axes()) offer(axis);
        offer_nearest(offer);
        const std::size_t most = found.size() + options_.normals;
        point3 all{};
        for (std::size_t i = 0; i < parts_.size(); ++i)
            for (const face_pair& pair : touching_pairs(i)) {
                auto out_of_b = normal_of(parts_[i].mesh(), pair.b);
                auto out_of_a = normal_of(a_, pair.a);
                if (out_of_b && looks_inward(parts_[i], pair.b)) out_of_b = scaled(*out_of_b, -1.0);
                if (out_of_a && !looks_inward(shape_, pair.a)) out_of_a = scaled(*out_of_a, -1.0);
                for (const auto& d : {out_of_b, out_of_a}) {
                    if (d) all = plus(all, *d);
                    if (found.size() < most) offer(d);
                }
            }
        offer(direction_of(all));
        if (all == point3{}) offer_through_walls(offer);
        return found;
    }

    [[nodiscard]] std::vector<face_pair> touching_pairs(std::size_t i) {
        if (!boxes_within(i, {})) return {};
        return intersect::mesh_intersections(a_, tree_, parts_[i].mesh(), parts_[i].faces(),
                                             {.limit = options_.face_pairs, .progress = asking_},
                                             options_.effort)
            .pairs;
    }

    /// Of a mesh inside another that it does not meet: both ways along the nearest line.
    template <class Offer>
    void offer_through_walls(const Offer& offer) const {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!boxes_within(i, {})) continue;
            const auto pair =
                nearness::closest_pair(a_, tree_, parts_[i].mesh(), parts_[i].faces());
            const point3 line{pair->on_b.x - pair->on_a.x, pair->on_b.y - pair->on_a.y,
                              pair->on_b.z - pair->on_a.z};
            offer(direction_of(line));
            offer(direction_of(scaled(line, -1.0)));
        }
    }

    /// Away from the nearest part; and where a walk gets to that always steps away from it.
    template <class Offer>
    void offer_nearest(const Offer& offer) const {
        constexpr double beyond = 1.0 + 0x1p-10;
        point3 offset{};
        for (int step = 0; step < 64; ++step) {
            const auto pair = nearest(offset);
            if (!pair || pair->distance >= options_.clearance || pair->distance == 0.0) break;
            const auto away =
                direction_of({pair->on_a.x - pair->on_b.x, pair->on_a.y - pair->on_b.y,
                              pair->on_a.z - pair->on_b.z});
            if (!away) break;
            if (step == 0) offer(away);
            offset = plus(offset, scaled(*away, options_.clearance * beyond - pair->distance));
        }
        offer(direction_of(offset));
    }

    const shape& shape_;
    mesh_view a_;
    const tree<3>& tree_;
    apart_options options_;
    base::work_progress work_;
    std::size_t looked_ = 0;  ///< directions
    progress_callback asking_ = [this](double) { return may_continue(); };
    std::optional<box3> box_;
    std::vector<shape> parts_;
    std::vector<box3> boxes_;
};

}  // namespace

separations search_separations(const shape& a, std::span<const shape> parts,
                               const apart_options& options) {
    if (!(options.clearance >= 0.0) || !std::isfinite(options.clearance))
        throw std::invalid_argument("treeform::separate: the clearance is negative or not finite");
    return clearing(a, parts, options).moves();
}

}  // namespace treeform::detail::place
