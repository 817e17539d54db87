#include "tools/tf-place/words.hpp"

#include "tools/common/console.hpp"
#include <treeform/tf.hpp>

namespace tools {
namespace {

const char* moved_word(place_mode mode, bool up) {
    switch (mode) {
        case place_mode::drop:
            return up ? "lifted" : "dropped";
        case place_mode::slide:
            return "slid";
        default:
            return "moved";
    }
}

/// The relation to the part that matters most.
std::string relation_in_words(const body& moving, const placement& p, const surroundings& among) {
    std::string text = name_of(p.status);
    if (p.on_bed) return text + (p.status == place_status::clear ? " of the bed" : " the bed");
    if (!p.nearest) return text;
    const std::string part = among.all()[p.nearest->part].label();
    const bool meet = p.status == place_status::touching || p.status == place_status::penetrating;
    if (!meet) return text + ", " + shortest(p.nearest->how.distance) + " from " + part;
    text += " " + part;
    const auto& how = p.nearest->how.relation;
    if (how.a_inside_b || how.b_inside_a)
        return text + (how.a_inside_b ? ", inside it" : ", which is inside");
    if (p.contacts.empty() || !p.contacts[0].fixed) return text;
    const contact_row& first = p.contacts[0];
    const body& met = among.all()[first.part];
    const char* const of = !moving.cloud && !met.cloud ? " of faces"
                           : moving.cloud && met.cloud ? " of points"
                           : moving.cloud              ? " of a point and a face"
                                                       : " of a face and a point";
    return text + " (" + counted(p.contact_count, "pair", "pairs") + of + ", the first " +
           std::to_string(moving.stored_face(first.moving)) + " and " +
           std::to_string(met.stored_face(*first.fixed)) + ")";
}

}  // namespace

const char* name_of(place_status status) {
    switch (status) {
        case place_status::separate:
            return "separate";
        case place_status::touching:
            return "touching";
        case place_status::penetrating:
            return "penetrating";
        case place_status::closer_than_clearance:
            return "closer-than-clearance";
        case place_status::clear:
            return "clear";
    }
    return "";
}

std::string verdict(const body& moving, const placement& p, const surroundings& among,
                    const place_settings& settings) {
    if (!p.placed) {
        std::string text = "not placed: " + p.reason;
        if (p.status == place_status::penetrating && p.nearest)
            text += " (" + relation_in_words(moving, p, among) + ")";
        return text;
    }
    if (settings.mode == place_mode::measure) return relation_in_words(moving, p, among);
    if (p.fit)
        return std::string(p.fit->converged ? "fitted" : "not converged") + " after " +
               counted(p.fit->iterations, "step", "steps") + "; rms " + shortest(p.fit->rms) +
               ", from " + shortest(p.fit->rms_at_start) + "; overlap " + shortest(p.fit->overlap);
    if (settings.mode == place_mode::lay)
        return "laid on side " + std::to_string(p.chosen) + " of " +
               std::to_string(p.sides.size()) + ", of area " + shortest(p.sides[p.chosen].area) +
               "; " + relation_in_words(moving, p, among);
    const std::string text = p.travel == 0.0
                                 ? "stays where it is"
                                 : std::string(moved_word(settings.mode, p.direction.z > 0.0)) +
                                       " by " + shortest(p.travel);
    return text + "; " + relation_in_words(moving, p, among);
}

void say_details(job& work, const placement& p, const surroundings& among) {
    console& out = work.out;
    if (!out.shows(level::info)) return;
    out.info(work.name + ": translation " +
             in_words({p.matrix.rows[0][3], p.matrix.rows[1][3], p.matrix.rows[2][3]}) + ", " +
             std::to_string(p.backed_off) + " steps taken back for rounding");
    if (p.nearest)
        out.info(work.name + ": nearest points " + in_words(p.nearest->how.on_a.point) + " and " +
                 in_words(p.nearest->how.on_b.point) + " of " +
                 among.all()[p.nearest->part].label());
    out.info(work.name + ": " + counted(among.indexed(), "fixed part", "fixed parts") + " of " +
             std::to_string(among.all().size()) + " indexed, " + grouped(p.skipped.pairs_tested) +
             " pairs of faces looked at in motion");
}

std::string in_words(const tf::point3& p) {
    std::string text = "(";
    text += shortest(p.x) + ", " + shortest(p.y) + ", " + shortest(p.z);
    return text += ")";
}

}  // namespace tools
