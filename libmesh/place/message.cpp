#include <libmesh/base/words.hpp>
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/placement.hpp>

#include <algorithm>
#include <cstddef>
#include <string>

namespace treeform {
namespace {

using detail::base::brief;
using detail::base::counted;
using detail::base::shortest;

std::string depth_of(const placement& p) {
    return "reaches " + shortest(p.below_bed) + " below " +
           (p.clearance > 0.0 ? "the clearance over the bed" : "the bed");
}

std::string too_far(const placement& p) {
    const std::string longest = shortest(p.max_travel.value_or(0.0));
    if (p.below_bed > 0.0) return depth_of(p) + ", but the largest travel is " + longest;
    if (p.travel > 0.0)
        return "the shortest translation found is longer than " + longest + ": " +
               shortest(p.travel);
    return "the nearest point is further away than " + longest;
}

/// "touching bed.stl", and the first pair of faces that meet.
std::string meeting_in_words(const placement& at, const body_set& moving, const body_set& fixed) {
    std::string text = name_of(at.relation) + (" " + fixed.label(at.nearest_fixed));
    const relation_result& how = *at.nearest;
    // Of a cloud it says only that some of the points are.
    if (how.a_inside_b) return text + (moving.file_of(0).cloud ? "" : ", inside it");
    if (how.b_inside_a)
        return text + (fixed.file_of(at.nearest_fixed).cloud ? "" : ", which is inside");
    if (at.contacts.empty() || !at.contacts[0].fixed_face) return text;
    const placement_contact& first = at.contacts[0];
    const bool cloud = moving.file_of(0).cloud, to_cloud = fixed.file_of(first.fixed).cloud;
    const char* const of = cloud && to_cloud ? " of points"
                           : cloud           ? " of a point and a face"
                           : to_cloud        ? " of a face and a point"
                                             : " of faces";
    return text + " (" + counted(at.contact_count, "pair", "pairs") + of + ", the first " +
           std::to_string(moving.face_in_file(0, first.moving)) + " and " +
           std::to_string(fixed.face_in_file(first.fixed, *first.fixed_face)) + ")";
}

std::string loose_in_words(std::size_t motions) {
    if (motions == 0) return {};
    return "; " + counted(motions, "motion is", "motions are") +
           " not determined: the mesh can slide or turn on the surface";
}

}  // namespace

std::string placement::relation_in_words(const body_set& moving, const body_set& fixed) const {
    const placement& at = *this;
    std::string how = name_of(at.relation);
    if (at.outcome == placement_outcome::bed)
        return how + (at.relation == mesh_relation::clear ? " of the bed" : " the bed");
    if (!at.nearest) return how;
    if (at.relation == mesh_relation::touching || at.relation == mesh_relation::penetrating)
        return meeting_in_words(at, moving, fixed);
    return how + ", " + brief(at.nearest->distance) + " from " + fixed.label(at.nearest_fixed);
}

std::string placement::message(std::span<const std::string> names) const {
    const bool floats = certificate.precision == treeform::precision::float32;
    const bool named = nearest && nearest_fixed < names.size();
    const std::string other = named ? names[nearest_fixed] : "a fixed mesh";
    switch (outcome) {
        case placement_outcome::starts_penetrating:
            return "penetrates " + other + " at the start";
        case placement_outcome::starts_too_near:
            return "is closer to " + other + " than the clearance at the start";
        case placement_outcome::starts_touching:
            return "touches " + other + " at the start, so there is no clearance";
        case placement_outcome::starts_below_bed:
            return depth_of(*this);
        case placement_outcome::nothing_met:
            return max_travel ? "no contact within a travel of " + shortest(*max_travel)
                              : "nothing is in the way";
        case placement_outcome::too_far:
            return too_far(*this);
        case placement_outcome::not_representable:
            if (effort.skipped_candidates > 0)
                return "no separating translation was found within " +
                       counted(effort.bound, "pair", "pairs") + " of faces";
            return std::string("no valid placement was found in ") +
                   (floats ? "float32" : "double") + " coordinates";
        case placement_outcome::too_many_steps:
            return "the search took too many steps: the motion passes close to a fixed mesh over a "
                   "long distance";
        case placement_outcome::out_of_range:
            return std::string("its coordinates at the new place would be beyond the range of ") +
                   (floats ? "float32" : "double");
        case placement_outcome::cancelled:
            return "stopped by its caller";
        default:
            return certificate ? "" : "there is no valid placement";
    }
}

std::size_t align_result::undetermined() const {
    return static_cast<std::size_t>(
        std::count_if(freedoms.begin(), freedoms.end(),
                      [](const align_freedom& one) { return one.stiffness < 1e-4; }));
}

std::string align_result::message() const {
    const std::string text = " after " + counted(iterations, "step", "steps") + "; rms " +
                             brief(rms) + ", from " + brief(rms_at_start) + "; overlap " +
                             brief(overlap) + loose_in_words(undetermined());
    switch (outcome) {
        case align_outcome::converged:
            return "aligned" + text;
        case align_outcome::doubtful:
            return "doubtful" + text + "; neighbors deviate to the same side (correlation " +
                   brief(correlation) +
                   ") or the data do not determine the position (uncertainty " +
                   brief(uncertainty) +
                   "): a wrong position, or parts without a partner; more "
                   "starts, or an overlap, may help";
        case align_outcome::out_of_iterations:
            return "not converged" + text + "; more iterations may help";
        default:
            return "not converged: nothing to align";
    }
}

std::string laid_flat::message() const {
    if (sides.empty()) return {};
    return "on side " + std::to_string(chosen) + " of " + std::to_string(sides.size()) +
           ", of area " + brief(sides[chosen].area);
}

placement laid_flat::as_placement() const {
    placement at{.certificate = certificate,
                 .outcome = placement_outcome::bed,
                 .points = points,
                 .matrix = matrix,
                 .bed = bed,
                 .relation = mesh_relation::touching};
    if (contact) at.contacts = {*contact};
    at.contact_count = at.contacts.size();
    return at;
}

placement align_result::as_placement() const {
    return {.certificate = {.status = status}, .points = points, .matrix = matrix};
}

}  // namespace treeform
