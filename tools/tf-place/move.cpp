#include "tools/tf-place/move.hpp"

#include "tools/common/console.hpp"
#include <libmesh/base/face_tree.hpp>
#include <libmesh/base/finite.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <treeform/mesh/clear.hpp>
#include <treeform/mesh/lay.hpp>
#include <treeform/mesh/mate.hpp>
#include <treeform/mesh/settle_among.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tools {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t contact_limit = 1000;

/// The least float32 value that is not below `x`.
double float_not_below(double x) {
    const double nearest = tf::detail::base::nearest_float(x);
    if (nearest >= x) return nearest;
    return static_cast<double>(
        std::nextafterf(static_cast<float>(nearest), std::numeric_limits<float>::infinity()));
}

class placing {
  public:
    placing(job& work, body& moving, const surroundings& among, const place_settings& settings,
            bool to_single)
        : work_(work), moving_(moving), among_(among), settings_(settings), to_single_(to_single) {
        result_.clearance = settings.clearance.used(tf::diagonal(*moving.box));
        result_.points = moving.mesh.points;
        if (settings.max_travel) longest_ = settings.max_travel->used(tf::diagonal(*moving.box));
    }

    [[nodiscard]] placement run() {
        const bool looks = settings_.mode != place_mode::fit;
        if (looks) look_at_start();
        bool in_range = true;
        try {
            find_place();
        } catch (const std::overflow_error&) {
            in_range = false;
        }
        if (!in_range || (result_.placed && !tf::detail::base::all_finite(result_.points))) {
            forget_place();
            fail(std::string("is beyond the range of ") + (to_single_ ? "float32" : "doubles") +
                 " at its place");
        }
        if (looks) look_at_place();
        return std::move(result_);
    }

  private:
    void find_place() {
        switch (settings_.mode) {
            case place_mode::drop:
            case place_mode::slide:
                along_direction();
                break;
            case place_mode::fit:
                fit();
                break;
            case place_mode::lay:
                lay();
                break;
            case place_mode::mate:
                mate();
                break;
            case place_mode::clear:
                make_clear();
                break;
            default:
                result_.placed = true;
                break;
        }
    }

    [[nodiscard]] place_status status_of(const std::optional<nearest_part>& near) const {
        const double c = result_.clearance;
        if (!near) return c > 0.0 ? place_status::clear : place_status::separate;
        switch (near->how.relation.relation) {
            case tf::mesh_relation::penetrating:
                return place_status::penetrating;
            case tf::mesh_relation::touching:
                return place_status::touching;
            default:
                break;
        }
        if (!(c > 0.0)) return place_status::separate;
        return near->how.distance < c ? place_status::closer_than_clearance : place_status::clear;
    }

    /// To be called after what has been given `work_.progress`.
    void over() {
        work_.out.end_progress();
        work_.keeper.check();
    }

    void look_at_start() {
        if (!among_.all().empty())
            result_.nearest = among_.nearest(moving_.mesh, moving_.faces(), *moving_.box,
                                             radius(0.0), work_.progress("look"));
        over();
        result_.status_at_start = status_of(result_.nearest);
        result_.status = result_.status_at_start;
    }

    /// How far to look for the nearest part. On the way along a direction only those matter that
    /// are met; others need not even be indexed.
    [[nodiscard]] double radius(double more) const {
        return settings_.moves_along_direction() ? result_.clearance + more : infinity;
    }

    void fail(const std::string& why) { result_.reason = why; }

    /// Says why nothing can move if that is so: penetrating, or nearer than the clearance.
    [[nodiscard]] bool stuck_at_start() {
        const std::string part =
            result_.nearest ? among_.all()[result_.nearest->part].label() : moving_.label();
        switch (result_.status_at_start) {
            case place_status::penetrating:
                fail("penetrates " + part + " where it is; clear would take it out");
                return true;
            case place_status::closer_than_clearance:
                fail("is nearer to " + part + " than the clearance where it is");
                return true;
            case place_status::touching:
                if (result_.clearance > 0.0)
                    fail("touches " + part + " where it is, which leaves no clearance");
                else
                    stay();
                return true;
            default:
                return false;
        }
    }

    /// The place is where MOVING is, if that can be written.
    void stay() { settle({}, {0.0, 0.0, -1.0}, 0.0, false, false); }

    void settle(const chosen_parts& known, const tf::point3& motion, double time, bool floor,
                bool forward, bool close_in = false) {
        const auto timing = work_.time("settle");
        const chosen_parts parts =
            known.parts.empty() ? among_.on_the_way(*moving_.box, motion, time, result_.clearance)
                                : known;
        tf::settle_among_options options{.to_single = to_single_,
                                         .clearance = result_.clearance,
                                         .forward = forward,
                                         .close_in = close_in,
                                         .progress = work_.progress("settle")};
        if (floor) options.floor = result_.bed->used;
        auto settled = tf::settle_among(moving_.mesh, parts.parts, motion, time, options);
        over();
        result_.backed_off = settled.backed_off;
        if (!settled.good) {
            fail(to_single_ ? "rounded to float32 there is no such place; --precision double, in a "
                              "format that has it, may find one"
                            : "there is no such place in coordinates that can be written");
            return;
        }
        result_.placed = true;
        result_.points = std::move(settled.points);
        for (std::size_t k = 0; k < 3; ++k)
            result_.matrix.rows[k][3] = settled.time * motion[k] + 0.0;  // no -0
        result_.travel = settled.time * length(motion);
        if (result_.travel > 0.0) {
            const double size = length(motion);
            result_.direction = {motion.x / size, motion.y / size, motion.z / size};
        }
    }

    void along_direction() {
        const tf::point3 motion =
            in_range(settings_.direction.value_or(tf::point3{0.0, 0.0, -1.0}));
        const double speed = length(motion);
        if (settings_.has_bed()) {
            const double above = height_above_bed();
            if (above < 0.0) return lift(motion, above);
            bed_time_ = above / -motion.z;
        }
        if (stuck_at_start()) return;
        const double allowed = longest_.value_or(infinity) / speed;
        const double latest = std::min(bed_time_, allowed);
        const chosen_parts parts =
            among_.on_the_way(*moving_.box, motion, latest, result_.clearance);
        result_.skipped.parts_culled = among_.all().size() - parts.parts.size();
        tf::slide_result slid;
        if (!parts.parts.empty()) slid = slide(parts, motion, latest);
        if (slid.end == tf::motion_end::contact) {
            result_.contacts = contacts_of(moving_, among_.all(), parts, slid, motion);
            result_.contact_count = slid.contact_count;
            settle(parts, motion, slid.time, settings_.has_bed(), false, true);
        } else if (bed_time_ < infinity && bed_time_ <= allowed) {
            result_.on_bed = true;
            settle(parts, motion, bed_time_, true, false);
        } else if (longest_) {
            fail("nothing is met within " + shortest(*longest_));
        } else {
            fail("nothing is in the way");
        }
    }

    [[nodiscard]] tf::slide_result slide(const chosen_parts& parts, const tf::point3& motion,
                                         double latest) {
        const auto timing = work_.time("search");
        auto slid = tf::slide(moving_.mesh, moving_.faces(), parts.parts, motion,
                              {.clearance = result_.clearance,
                               .latest = latest,
                               .limit = contact_limit,
                               .progress = work_.progress("search")});
        over();
        result_.skipped.pairs_tested = slid.pairs_tested;
        result_.skipped.predicates = slid.predicates;
        return slid;
    }

    /// How far the lowest point is above the bed, and the clearance over it; negative below it.
    [[nodiscard]] double height_above_bed() {
        const double given = settings_.bed.value_or(0.0);
        const double level = given + result_.clearance;
        result_.bed = bed_level{given, bed_to_write(level, to_single_)};
        return moving_.box->min.z - result_.bed->used;
    }

    /// From below the bed, back along the direction up to it, where nothing can be in the way.
    void lift(const tf::point3& motion, double above) {
        const bool below = moving_.box->min.z < result_.bed->given;
        result_.status_at_start =
            below ? place_status::penetrating : place_status::closer_than_clearance;
        result_.status = result_.status_at_start;
        const std::string depth =
            "reaches " + shortest(-above) + " below " +
            (result_.clearance > 0.0 ? "the clearance over the bed" : "the bed");
        if (!among_.all().empty())
            return fail(depth +
                        "; with --fixed, drop only goes down: drop it without --fixed first");
        const double time = above / motion.z;
        if (longest_ && time > *longest_ / length(motion))
            return fail(depth + ", further than " + shortest(*longest_));
        result_.on_bed = true;
        settle({}, {0.0 - motion.x, 0.0 - motion.y, 0.0 - motion.z}, time, true, false);
    }

    void lay() {
        const auto timing = work_.time("search");
        tf::lay_options options = settings_.lay;
        const double given = settings_.bed.value_or(0.0);
        options.bed = bed_to_write(given, to_single_);
        options.to_single = to_single_;
        options.tolerance = result_.tolerance = settings_.flatness.used(tf::diagonal(*moving_.box));
        options.progress = work_.progress("search");
        auto laid = tf::lay(moving_.mesh, options);
        over();
        if (!laid) return fail("has no side: all its points are on a line");
        result_.placed = true;
        result_.on_bed = true;
        result_.bed = bed_level{given, laid->bed};
        result_.points = std::move(laid->points);
        result_.matrix = laid->matrix;
        result_.sides = std::move(laid->sides);
        result_.chosen = laid->chosen;
        result_.corrected = laid->corrected;
    }

    void fit() {
        const auto timing = work_.time("search");
        tf::fit_options options = settings_.fit;
        if (settings_.max_distance)
            options.max_distance = settings_.max_distance->used(tf::diagonal(*moving_.box));
        options.progress = work_.progress("search");
        const body& fixed = among_.all()[0];
        const tf::mesh_view to{fixed.mesh.points,
                               fixed.cloud ? std::span<const tf::face>{} : fixed.mesh.faces};
        result_.fit = tf::fit(moving_.mesh.points, to, options);
        over();
        result_.placed = true;
        result_.complete = result_.fit->converged;
        result_.matrix = result_.fit->matrix;
        for (tf::point3& p : result_.points) {
            p = result_.matrix(p);
            for (std::size_t k = 0; k < 3 && to_single_; ++k)
                p[k] = tf::detail::base::nearest_float(p[k]);
        }
    }

    void mate() {
        if (stuck_at_start()) return;
        const tf::mesh_measure& near = result_.nearest->how;
        const tf::point3 way = tf::way_between(near);
        if (way == tf::point3{}) return stay();
        const chosen_parts parts =
            among_.on_the_way(*moving_.box, way, 1.0 + 0x1p-20, result_.clearance);
        result_.skipped.parts_culled = among_.all().size() - parts.parts.size();
        const auto timing = work_.time("search");
        const tf::mate_result found = tf::mate(near, moving_.mesh, moving_.faces(), parts.parts,
                                               {.clearance = result_.clearance,
                                                .limit = contact_limit,
                                                .progress = work_.progress("search")});
        over();
        result_.skipped.pairs_tested = found.met.pairs_tested;
        result_.skipped.predicates = found.met.predicates;
        result_.contacts = contacts_of(moving_, among_.all(), parts, found.met, way);
        result_.contact_count = found.met.contact_count;
        if (found.time * length(way) > longest_.value_or(infinity))
            fail("the nearest point is further away than " + shortest(*longest_));
        else
            settle(parts, way, found.time, false, false);
    }

    void make_clear() {
        const bool near =
            result_.status_at_start == place_status::penetrating ||
            (result_.clearance > 0.0 && result_.status_at_start != place_status::clear);
        if (!near) return stay();
        // The way out of what is near, if nothing else is there; else out of more.
        double reach = result_.clearance;
        while (true) {
            const chosen_parts parts = among_.around(*moving_.box, reach);
            result_.skipped.parts_culled = among_.all().size() - parts.parts.size();
            leave(parts);
            if (!result_.placed) return;
            const tf::box3 there = *tf::bounding_box(result_.points);
            if (!among_.others_around(there, result_.clearance, parts)) return;
            reach = std::max({2.0 * reach, result_.travel + result_.clearance,
                              tf::diagonal(*moving_.box) * 0x1p-6});
            forget_place();
        }
    }

    void forget_place() {
        result_.placed = result_.on_bed = false;
        result_.contacts.clear();
        result_.contact_count = 0;
        result_.reason.clear();
        result_.points = moving_.mesh.points;
        result_.matrix = {};
        result_.direction = {};
        result_.travel = 0.0;
    }

    /// To the first place that can be written at which MOVING is clear of these.
    void leave(const chosen_parts& parts) {
        tf::clear_result found;
        {
            const auto timing = work_.time("search");
            found = tf::clear_moves(
                moving_.mesh, moving_.faces(), parts.parts,
                {.clearance = result_.clearance, .progress = work_.progress("search")});
        }
        over();
        const std::vector<tf::clear_move>& moves = found.moves;
        for (const tf::clear_move& move : moves) {
            if (move.time > longest_.value_or(infinity)) break;
            settle(parts, move.direction, move.time, false, true);
            if (result_.placed) return;
        }
        if (moves.empty()) return stay();
        if (result_.reason.empty())
            fail("the shortest translation found is longer than " + shortest(*longest_) + ": " +
                 shortest(moves[0].time));
    }

    /// What is true at the place, in the coordinates that are written.
    void look_at_place() {
        const tf::mesh_view there{result_.points, moving_.mesh.faces};
        const bool moved = result_.points != moving_.mesh.points;
        std::optional<tf::tree<3>> own;
        if (moved) {
            const tf::box3 box = *tf::bounding_box(there.points);
            if (!among_.all().empty()) {
                own = tf::face_tree(there);
                result_.nearest = among_.nearest(
                    there, *own, box, radius(tf::diagonal(box) * 0x1p-10), work_.progress("look"));
                over();
            }
            result_.status = status_of(result_.nearest);
        }
        if (result_.on_bed) on_bed_at_place(there);
        if (among_.all().empty() || !result_.contacts.empty()) return;
        if (result_.status == place_status::touching || result_.status == place_status::penetrating)
            result_.contacts = contacts_at(there, moved ? *own : moving_.faces(), among_.all(),
                                           contact_limit, result_.contact_count);
    }

    void on_bed_at_place(tf::mesh_view there) {
        if (const auto contact = contact_with_bed(there)) {
            result_.contacts.push_back(*contact);
            ++result_.contact_count;
        }
        if (result_.status == place_status::separate) result_.status = place_status::touching;
    }

    job& work_;
    body& moving_;
    const surroundings& among_;
    const place_settings& settings_;
    bool to_single_;
    std::optional<double> longest_{};
    double bed_time_ = infinity;
    placement result_{};
};

}  // namespace

double bed_to_write(double given, bool to_single) {
    if (!to_single) return given;
    if (!(std::abs(given) <= static_cast<double>(std::numeric_limits<float>::max())))
        throw failure(bad_usage, "usage",
                      "--bed: " + shortest(given) +
                          " is beyond the range of float32, which is what will be written; a "
                          "format of text, or --precision double in PLY, has more");
    return float_not_below(given);
}

placement place(job& work, body& moving, const surroundings& among, const place_settings& settings,
                bool to_single) {
    return placing(work, moving, among, settings, to_single).run();
}

}  // namespace tools
