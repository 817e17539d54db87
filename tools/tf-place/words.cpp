#include "tools/common/console.hpp"
#include "tools/tf-place/outcome.hpp"
#include <treeform/tf.hpp>

#include <array>

namespace tools {
namespace {

const char* moved_word(place_mode mode, bool up) {
    if (mode == place_mode::drop) return up ? "lifted" : "dropped";
    return mode == place_mode::slide ? "slid" : "moved";
}

/// The relation to the body that matters most.
std::string relation_in_words(const body& moving, const outcome& found, const body_set& fixed) {
    const tf::placement& p = found.at;
    std::string text = name_of(p.at_place);
    if (p.on_bed) return text + (p.at_place == tf::standing::clear ? " of the bed" : " the bed");
    if (!p.nearest) return text;
    const std::string part = fixed.bodies[p.nearest->fixed].label();
    const bool meet =
        p.at_place == tf::standing::touching || p.at_place == tf::standing::penetrating;
    if (!meet) return text + ", " + shortest(p.nearest->how.distance) + " from " + part;
    text += " " + part;
    const auto& how = p.nearest->how.relation;
    if (how.a_inside_b || how.b_inside_a)
        return text + (how.a_inside_b ? ", inside it" : ", which is inside");
    if (p.contacts.empty() || !p.contacts[0].fixed_face) return text;
    const tf::placement_contact& first = p.contacts[0];
    const body& met = fixed.bodies[first.fixed];
    const char* const of = !moving.cloud && !met.cloud ? " of faces"
                           : moving.cloud && met.cloud ? " of points"
                           : moving.cloud              ? " of a point and a face"
                                                       : " of a face and a point";
    return text + " (" + counted(p.contact_count, "pair", "pairs") + of + ", the first " +
           std::to_string(moving.stored_face(first.moving)) + " and " +
           std::to_string(met.stored_face(*first.fixed_face)) + ")";
}

}  // namespace

const char* name_of(tf::standing standing) {
    constexpr std::array<const char*, 5> names{"separate", "touching", "penetrating",
                                               "closer-than-clearance", "clear"};
    return names[static_cast<std::size_t>(standing)];
}

std::string verdict(const body& moving, const outcome& found, const body_set& fixed,
                    const place_settings& settings) {
    const tf::placement& p = found.at;
    if (!p) {
        std::string text = "not placed: " + found.reason;
        if (p.at_place == tf::standing::penetrating && p.nearest)
            text += " (" + relation_in_words(moving, found, fixed) + ")";
        return text;
    }
    if (settings.mode == place_mode::measure) return relation_in_words(moving, found, fixed);
    if (const auto& fit = found.aligned)
        return std::string(fit->converged ? "fitted" : "not converged") + " after " +
               counted(fit->iterations, "step", "steps") + "; rms " + shortest(fit->rms) +
               ", from " + shortest(fit->rms_at_start) + "; overlap " + shortest(fit->overlap);
    if (const auto& laid = found.laid)
        return "laid on side " + std::to_string(laid->chosen) + " of " +
               std::to_string(laid->sides.size()) + ", of area " +
               shortest(laid->sides[laid->chosen].area) + "; " +
               relation_in_words(moving, found, fixed);
    const std::string text = p.travel == 0.0
                                 ? "stays where it is"
                                 : std::string(moved_word(settings.mode, p.direction.z > 0.0)) +
                                       " by " + shortest(p.travel);
    return text + "; " + relation_in_words(moving, found, fixed);
}

void say_details(job& work, const outcome& found, const body_set& fixed) {
    console& out = work.out;
    const tf::placement& p = found.at;
    if (!out.shows(level::info)) return;
    out.info(work.name + ": translation " +
             in_words({p.matrix.rows[0][3], p.matrix.rows[1][3], p.matrix.rows[2][3]}) + ", " +
             std::to_string(p.statistics.backed_off) + " steps taken back for rounding");
    if (p.nearest)
        out.info(work.name + ": nearest points " + in_words(p.nearest->how.on_a.point) + " and " +
                 in_words(p.nearest->how.on_b.point) + " of " +
                 fixed.bodies[p.nearest->fixed].label());
    out.info(work.name + ": " + counted(fixed.indexed(), "fixed part", "fixed parts") + " of " +
             std::to_string(fixed.bodies.size()) + " indexed, " +
             grouped(p.statistics.pairs_tested) + " pairs of faces looked at in motion");
}

}  // namespace tools
