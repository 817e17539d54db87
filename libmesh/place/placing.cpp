#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/place/contacts.hpp>
#include <libmesh/place/placing.hpp>
#include <libmesh/place/separation_search.hpp>
#include <libmesh/place/shape.hpp>
#include <libmesh/place/snap_to_representable.hpp>
#include <libmesh/place/sweep_among.hpp>
#include <treeform/mesh/certificate.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::place {
namespace {

/// The same direction, exactly: along an axis of length 1, else scaled by a power of two.
point3 in_range_of_doubles(const point3& direction) {
    double largest = 0.0;
    int axes = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(direction[k]));
        axes += direction[k] != 0.0;
    }
    point3 scaled = direction;
    for (std::size_t k = 0; k < 3; ++k)
        if (direction[k] != 0.0)
            scaled[k] = axes == 1 ? std::copysign(1.0, direction[k])
                                  : std::ldexp(direction[k], -std::ilogb(largest));
    return scaled;
}

[[noreturn]] void refuse(const char* function, const char* what) {
    throw std::invalid_argument("treeform::" + std::string(function) + ": " + what);
}

void check(const char* function, const placement_options& o) {
    if (!(o.clearance >= 0.0) || !std::isfinite(o.clearance))
        refuse(function, "the clearance is negative or not finite");
    if (o.max_travel && !(*o.max_travel >= 0.0))
        refuse(function, "the largest travel is negative or NaN");
    if (o.bed && !std::isfinite(not_below(*o.bed + o.clearance, o.precision)))
        refuse(function, "the bed is above the range of coordinates that can be written");
}

}  // namespace

placing::placing(const char* function, const prepared_mesh& moving,
                 std::span<const prepared_mesh> fixed, const placement_options& options,
                 looking where)
    : prepared_(moving),
      moving_(moving, options.vertices),
      among_(fixed, options.vertices),
      function_(function),
      options_(options),
      where_(where),
      work_(options_.progress) {
    check(function, options);
    check_operand(function, "moving", moving.indexed_view());
    faces_ = moving.indexed_view().faces.size();
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        check_operand(function, "fixed " + std::to_string(i), fixed[i].indexed_view());
        faces_ += fixed[i].indexed_view().faces.size();
    }
    box_ = box_of_faces(moving.indexed_view());
    if (options.max_travel) longest_ = *options.max_travel;
    result_.max_travel = options.max_travel;
    result_.certificate.precision = options.precision;
    result_.clearance = options.clearance;
    result_.points.assign(moving.indexed_view().points.begin(), moving.indexed_view().points.end());
    if (options.bed) result_.bed = not_below(*options.bed + options.clearance, options.precision);
}

void placing::in_range(const function_ref<void()>& find) {
    bool fits = true;
    try {
        if (box_)
            find();
        else
            result_.outcome = placement_outcome::nothing_met;
    } catch (const std::overflow_error&) {
        fits = false;
    }
    if (fits && (!placed() || !box_ || base::all_finite(result_.points))) return;
    forget_place();
    result_.outcome = placement_outcome::out_of_range;
}

placement placing::finished() {
    certificate& known = result_.certificate;
    const points_view given = prepared_.indexed_view().points;
    if (placed())
        known.max_displacement = detail::max_displacement(given, result_.matrix, result_.points);
    switch (result_.outcome) {
        case placement_outcome::out_of_range:
            known.status = status::out_of_range;
            break;
        default:
            known.status = placed() ? status::ok : status::no_placement;
            break;
    }
    return std::move(result_);
}

mesh_relation placing::relation_of(const std::optional<relation_result>& near) const {
    const double c = options_.clearance;
    if (!near) return c > 0.0 ? mesh_relation::clear : mesh_relation::disjoint;
    switch (near->relation) {
        case mesh_relation::penetrating:
            return mesh_relation::penetrating;
        case mesh_relation::touching:
            return mesh_relation::touching;
        default:
            break;
    }
    if (!(c > 0.0)) return mesh_relation::disjoint;
    return near->distance < c ? mesh_relation::closer_than_clearance : mesh_relation::clear;
}

void placing::find_nearest(const shape& a, const box3& box, double radius, double begin,
                           double end) {
    const auto near = among_.nearest(a, box, radius, work_.part(begin, end));
    result_.nearest.reset();
    result_.nearest_fixed = near ? near->number : 0;
    if (near) result_.nearest = near->how;
}

void placing::look_at_start() {
    if (!among_.empty() && box_) find_nearest(moving_, *box_, radius(0.0), 0.0, 0.2);
    over();
    result_.relation_at_start = result_.relation = relation_of(result_.nearest);
}

/// How far to look for the nearest mesh. On the way along a direction only those matter that are
/// met; others need not even be indexed.
double placing::radius(double more) const {
    return where_ == looking::on_the_way ? options_.clearance + more
                                         : std::numeric_limits<double>::infinity();
}

bool placing::stuck_at_start() {
    switch (result_.relation_at_start) {
        case mesh_relation::penetrating:
            result_.outcome = placement_outcome::starts_penetrating;
            return true;
        case mesh_relation::closer_than_clearance:
            result_.outcome = placement_outcome::starts_too_near;
            return true;
        case mesh_relation::touching:
            if (options_.clearance > 0.0)
                result_.outcome = placement_outcome::starts_touching;
            else
                stay();
            return true;
        default:
            return false;
    }
}

void placing::stay() { settle({}, {0.0, 0.0, -1.0}, 0.0, placement_outcome::unchanged); }

/// Writes the place down: `end` is what it is then, if it can be written.
void placing::settle(const chosen_parts& known, const point3& motion, double time,
                     placement_outcome end, bool close_in, base::effort* effort) {
    const bool forward = effort != nullptr;  // out of something
    const chosen_parts parts =
        known.parts.empty() ? among_.on_the_way(*box_, motion, time, options_.clearance) : known;
    snap_options options{.precision = options_.precision,
                         .clearance = options_.clearance,
                         .forward = forward,
                         .close_in = close_in,
                         .effort = effort,
                         .progress = work_.part(0.6, 0.85)};
    if (result_.bed && end != placement_outcome::unchanged && !forward) options.floor = result_.bed;
    auto settled = snap_to_representable(prepared_, parts.parts, motion, time, options);
    over();
    result_.statistics.backed_off = settled.backed_off;
    if (!settled.good) {
        result_.outcome = placement_outcome::not_representable;
        return;
    }
    result_.outcome = end;
    result_.points = std::move(settled.points);
    for (std::size_t k = 0; k < 3; ++k)
        result_.matrix.rows[k][3] = settled.time * motion[k] + 0.0;  // no -0
    result_.travel = settled.time * length_of(motion);
    if (result_.travel > 0.0) {
        const double size = length_of(motion);
        result_.direction = {motion.x / size, motion.y / size, motion.z / size};
    }
}

void placing::slide(const point3& direction) {
    if (!base::is_finite(direction) || direction == point3{})
        refuse(function_, "the direction is zero or not finite");
    const point3 motion = in_range_of_doubles(direction);
    double bed_time = std::numeric_limits<double>::infinity();
    if (result_.bed) {
        if (!(motion.z < 0.0)) refuse(function_, "the direction does not lead down to the bed");
        const double above = box_->min.z - *result_.bed;
        if (above < 0.0) return lift(motion, above);
        bed_time = above / -motion.z;
    }
    if (stuck_at_start()) return;
    const double allowed = longest_ / length_of(motion);
    const double latest = std::min(bed_time, allowed);
    const chosen_parts parts = among_.on_the_way(*box_, motion, latest, options_.clearance);
    result_.statistics.fixed_culled = among_.size() - parts.parts.size();
    sweep_result met;
    if (!parts.parts.empty())
        met = sweep_among(moving_, parts.parts, motion,
                          {.clearance = options_.clearance,
                           .latest = latest,
                           .limit = options_.limit,
                           .progress = work_.part(0.2, 0.6)});
    over();
    result_.statistics.pairs_tested = met.pairs_tested;
    result_.statistics.predicates = met.predicates;
    if (met.outcome == placement_outcome::contact) {
        result_.contacts = contacts_of(moving_, parts, met, motion);
        result_.contact_count = met.contact_count;
        settle(parts, motion, met.time, placement_outcome::contact, options_.close_in);
    } else if (std::isfinite(bed_time) && bed_time <= allowed) {
        settle(parts, motion, bed_time, placement_outcome::bed);
    } else {
        result_.outcome = placement_outcome::nothing_met;
    }
}

/// From below the bed, back along the direction up to it, where nothing can be in the way.
void placing::lift(const point3& motion, double above) {
    const bool below = box_->min.z < *options_.bed;
    result_.relation_at_start =
        below ? mesh_relation::penetrating : mesh_relation::closer_than_clearance;
    result_.relation = result_.relation_at_start;
    result_.below_bed = -above;
    if (!among_.empty()) {
        result_.outcome = placement_outcome::starts_below_bed;
        return;
    }
    const double time = above / motion.z;
    if (time > longest_ / length_of(motion)) {
        result_.outcome = placement_outcome::too_far;
        return;
    }
    settle({}, {0.0 - motion.x, 0.0 - motion.y, 0.0 - motion.z}, time, placement_outcome::bed);
}

void placing::mate() {
    if (!result_.nearest) {
        result_.outcome = placement_outcome::nothing_met;
        return;
    }
    if (stuck_at_start()) return;
    const relation_result near = *result_.nearest;
    const point3 way = way_between(near);
    if (way == point3{}) return stay();
    const chosen_parts parts = among_.on_the_way(*box_, way, 1.0 + 0x1p-20, options_.clearance);
    result_.statistics.fixed_culled = among_.size() - parts.parts.size();
    const mate_motion found = motion_to_mate(near, moving_, parts.parts,
                                             {.clearance = options_.clearance,
                                              .limit = options_.limit,
                                              .progress = work_.part(0.2, 0.6)});
    over();
    result_.statistics.pairs_tested = found.met.pairs_tested;
    result_.statistics.predicates = found.met.predicates;
    result_.contacts = contacts_of(moving_, parts, found.met, way);
    result_.contact_count = found.met.contact_count;
    if (found.time * length_of(way) > longest_) {
        result_.outcome = placement_outcome::too_far;
        return;
    }
    settle(parts, way, found.time, placement_outcome::contact);
}

void placing::separate() {
    const bool near =
        result_.relation_at_start == mesh_relation::penetrating ||
        (options_.clearance > 0.0 && result_.relation_at_start != mesh_relation::clear);
    // If rounding brings the mesh too near to a neighbor again, the search keeps a step more.
    double kept = options_.clearance;
    const auto keep_more = [&] {
        if (result_.outcome != placement_outcome::not_representable) return false;
        if (kept > options_.clearance) return false;
        kept += coordinate_step(prepared_.indexed_view().points, options_.precision);
        forget_place();
        return true;
    };
    if (!near) {
        stay();
        if (!keep_more()) return;
    }
    // The way out of what is near, if nothing else is there; else out of more.
    double reach = kept;
    base::effort effort(options_.effort, faces_);
    while (true) {
        const chosen_parts parts = among_.around(*box_, reach);
        result_.statistics.fixed_culled = among_.size() - parts.parts.size();
        leave(parts, kept, effort);
        result_.effort = effort.so_far();
        if (keep_more()) continue;
        if (!placed()) return;
        const box3 there = *box_of_faces({result_.points, prepared_.indexed_view().faces});
        if (!among_.others_around(there, options_.clearance, parts)) return;
        reach =
            std::max({2.0 * reach, result_.travel + options_.clearance, box_->diagonal() * 0x1p-6});
        forget_place();
    }
}

/// To the first place that can be written at which the mesh is clear of these.
void placing::leave(const chosen_parts& parts, double clearance, base::effort& effort) {
    effort.hold(0.5);  // for the judgments
    const separations found = search_separations(moving_, parts.parts,
                                                 {.clearance = clearance,
                                                  .normals = options_.normals,
                                                  .face_pairs = options_.face_pairs,
                                                  .effort = &effort,
                                                  .progress = work_.part(0.2, 0.6)});
    over();
    effort.hold(0.0);
    bool tried = false;
    for (const separation& move : found.moves) {
        if (move.time > longest_) break;
        tried = true;
        settle(parts, move.direction, move.time, placement_outcome::moved_apart, false, &effort);
        if (placed()) return;
    }
    if (found.moves.empty()) return stay();
    if (tried) return;
    result_.outcome = placement_outcome::too_far;
    result_.travel = found.moves[0].time;
}

void placing::forget_place() {
    result_.outcome = placement_outcome::unchanged;
    result_.contacts.clear();
    result_.contact_count = 0;
    const points_view given = prepared_.indexed_view().points;
    result_.points.assign(given.begin(), given.end());
    result_.matrix = {};
    result_.direction = {};
    result_.travel = 0.0;
}

/// What is true at the place, in the coordinates that are written.
void placing::look_at_place() {
    const mesh_view here = prepared_.indexed_view();
    const mesh_view there{result_.points, here.faces};
    const bool moved = !std::equal(here.points.begin(), here.points.end(), result_.points.begin());
    std::optional<tree<3>> own;
    if (moved && !among_.empty()) own = build_face_tree(there);
    const shape at = own ? shape(prepared_, result_.points, *own, options_.vertices) : moving_;
    if (moved) {
        if (!among_.empty()) {
            const box3 box = *box_of_faces(there);
            find_nearest(at, box, radius(box.diagonal() * 0x1p-10), 0.85, 1.0);
            over();
        }
        result_.relation = relation_of(result_.nearest);
    }
    if (result_.outcome == placement_outcome::bed) on_bed_at_place(there);
    if (among_.empty() || !result_.contacts.empty()) return;
    if (result_.relation == mesh_relation::touching ||
        result_.relation == mesh_relation::penetrating)
        result_.contacts = contacts_at(at, among_, options_.limit, result_.contact_count);
}

void placing::on_bed_at_place(mesh_view there) {
    if (const auto contact = contact_with_bed(there)) {
        result_.contacts.push_back(*contact);
        ++result_.contact_count;
    }
    if (result_.relation == mesh_relation::disjoint) result_.relation = mesh_relation::touching;
}

}  // namespace treeform::detail::place
