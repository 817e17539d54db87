#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/snap_to_representable.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::place {
namespace {

class settling {
  public:
    settling(const prepared_mesh& a, std::span<const shape> parts, const point3& motion,
             const snap_options& options)
        : prepared_(a),
          a_(a.indexed_view()),
          parts_(parts),
          motion_(motion),
          options_(options),
          work_(options_.progress) {
        for (const shape& part : parts) boxes_.push_back(bounding_box(part.mesh().points));
    }

    [[nodiscard]] snapped at(double time, bool rests) {
        ++tries_;
        snapped one;
        one.time = time;
        one.points.assign(a_.points.begin(), a_.points.end());
        for (point3& p : one.points)
            for (std::size_t k = 0; k < 3; ++k) {
                const double product = time * motion_[k];
                p[k] += product;
                if (single()) p[k] = base::nearest_float(p[k]);
            }
        if (!base::all_finite(one.points)) {
            one.good = false;
            return one;
        }
        if (options_.floor) put_on_floor(one.points, rests);
        look_around(one);
        return one;
    }

    [[nodiscard]] bool cancelled() const { return work_.cancelled(); }
    [[nodiscard]] bool single() const { return options_.precision == precision::float32; }

    [[nodiscard]] snapped finished(snapped found) {
        work_.reach(1.0);
        if (cancelled()) found.status = status::cancelled;
        return found;
    }

    /// The least time that moves a coordinate by a unit in the last place of the largest.
    [[nodiscard]] double unit_of_time(const std::vector<point3>& points) const {
        double largest = 0.0;
        double speed = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            speed = std::max(speed, std::abs(motion_[k]));
            if (motion_[k] == 0.0) continue;
            for (const point3& p : points) largest = std::max(largest, std::abs(p[k]));
        }
        if (largest == 0.0) return std::numeric_limits<double>::denorm_min() / speed;
        const double unit = std::ldexp(1.0, std::ilogb(largest) - (single() ? 23 : 52));
        return std::max(unit, std::numeric_limits<double>::denorm_min()) / speed;
    }

  private:
    void put_on_floor(std::vector<point3>& points, bool rests) const {
        double level = *options_.floor;
        const auto box = box_of_faces({points, a_.faces});
        const auto before = box_of_faces(a_);
        if (rests && box && before) {
            double largest = std::abs(level);
            for (const double z : {box->min.z, box->max.z, before->min.z, before->max.z})
                largest = std::max(largest, std::abs(z));
            if (box->min.z - level <= std::ldexp(largest, single() ? -21 : -50))
                level = std::max(level, box->min.z);
        }
        for (point3& p : points)
            if (p.z <= level) p.z = *options_.floor;
    }

    void look_around(snapped& one) {
        const mesh_view there{one.points, a_.faces};
        const auto box = bounding_box(one.points);
        one.good = true;
        if (!box || a_.faces.empty()) return;
        std::optional<tree<3>> faces;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const shape& part = parts_[i];
            if (!boxes_[i] || part.mesh().faces.empty()) continue;
            if (!within(*box, *boxes_[i], options_.clearance)) continue;
            const auto may_continue = [&](double) { return work_.step(0.0, 0.9, tries_, 4.0); };
            if (!may_continue(0.0)) return;
            if (!faces) faces = build_face_tree(there);
            const shape moved(prepared_, one.points, *faces, part.vertices());
            const auto judged = relation_of(moved, part, may_continue, options_.effort);
            if (judged.status == status::cancelled) {
                one.good = false;
                return;
            }
            const mesh_relation how = judged.relation;
            const bool near =
                how == mesh_relation::disjoint && options_.clearance > 0.0 && nearer(moved, part);
            const bool too_near = how == mesh_relation::penetrating || near ||
                                  (options_.clearance > 0.0 && how == mesh_relation::touching);
            if (how > one.relation || (too_near && one.good && how == one.relation)) one.part = i;
            one.relation = std::max(one.relation, how);
            one.good = one.good && !too_near;
            if (how == mesh_relation::penetrating) return;
        }
    }

    [[nodiscard]] bool nearer(const shape& moved, const shape& part) const {
        const auto pair = nearness::closest_pair(moved.mesh(), moved.faces(), part.mesh(),
                                                 part.faces(), options_.clearance);
        return pair && pair->distance < options_.clearance;
    }

    const prepared_mesh& prepared_;
    mesh_view a_;
    std::span<const shape> parts_;
    point3 motion_;
    snap_options options_;
    base::work_progress work_;
    std::size_t tries_ = 0;
    std::vector<std::optional<box3>> boxes_;
};

void check(const point3& motion, double time, const snap_options& options) {
    double speed = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        speed = std::isnan(motion[k]) ? motion[k] : std::max(speed, std::abs(motion[k]));
    if (!(std::isfinite(speed) && speed > 0.0) || !(time >= 0.0) || !std::isfinite(time))
        throw std::invalid_argument("treeform: the motion or the time is not finite, or zero");
    if (!(options.clearance >= 0.0) || !std::isfinite(options.clearance))
        throw std::invalid_argument("treeform: the clearance is negative or not finite");
}

}  // namespace

snapped snap_to_representable(const prepared_mesh& a, std::span<const shape> parts,
                              const point3& motion, double time, const snap_options& options) {
    check(motion, time, options);
    settling place(a, parts, motion, options);
    snapped best = place.at(time, true);
    if (!base::all_finite(best.points))
        throw std::overflow_error("treeform: the coordinates at the new place are too large");
    const double unit = place.unit_of_time(best.points);
    const auto closed_in = [&](snapped found) {
        const bool wanted = options.close_in && !options.forward && !(options.clearance > 0.0);
        for (int steps = 0; wanted && steps < 4 && found.good &&
                            found.relation == mesh_relation::disjoint && !place.cancelled();
             ++steps) {
            snapped next = place.at(found.time + unit, true);
            if (!next.good) break;
            next.backed_off = found.backed_off;
            found = std::move(next);
        }
        return place.finished(std::move(found));
    };
    if (best.good) return closed_in(std::move(best));

    const auto back = [&](double step) {
        return options.forward ? time + step : std::max(0.0, time - step);
    };
    double bad = time;
    double step = unit;
    const auto may_continue = [&] { return !options.effort || !options.effort->spent(); };
    while (!best.good && best.backed_off < options.attempts && may_continue()) {
        const unsigned count = best.backed_off + 1;
        bad = best.time;
        best = place.at(back(step), false);
        best.backed_off = count;
        if (best.time == 0.0) break;  // where it came from
        step *= 2.0;
    }
    // The first good place may be far behind the last bad one.
    while (best.good && std::abs(bad - best.time) > 2.0 * unit &&
           best.backed_off < options.attempts && !place.cancelled()) {
        const unsigned count = best.backed_off + 1;
        snapped middle = place.at(best.time + (bad - best.time) / 2, false);
        if (middle.good)
            best = std::move(middle);
        else
            bad = middle.time;
        best.backed_off = count;
    }
    return closed_in(std::move(best));
}

}  // namespace treeform::detail::place
