#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/placement.hpp>

#include <charconv>
#include <string>

namespace treeform {
namespace {

/// The shortest decimal text that reads back as `value`.
std::string shortest(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string depth_of(const placement& p) {
    return "reaches " + shortest(p.below_bed) + " below " +
           (p.clearance > 0.0 ? "the clearance over the bed" : "the bed");
}

std::string too_far(const placement& p) {
    const std::string longest = shortest(p.max_travel.value_or(0.0));
    if (p.below_bed > 0.0) return depth_of(p) + ", further than " + longest;
    if (p.travel > 0.0)
        return "the shortest translation found is longer than " + longest + ": " +
               shortest(p.travel);
    return "the nearest point is further away than " + longest;
}

}  // namespace

std::string placement::message(std::span<const std::string> names) const {
    const bool floats = certificate.precision == treeform::precision::float32;
    const bool named = nearest && nearest->fixed < names.size();
    const std::string other = named ? names[nearest->fixed] : "something fixed";
    switch (end) {
        case placement_end::starts_penetrating:
            return "penetrates " + other + " where it is";
        case placement_end::starts_too_near:
            return "is nearer to " + other + " than the clearance where it is";
        case placement_end::starts_touching:
            return "touches " + other + " where it is, which leaves no clearance";
        case placement_end::starts_below_bed:
            return depth_of(*this);
        case placement_end::nothing_met:
            return max_travel ? "nothing is met within " + shortest(*max_travel)
                              : "nothing is in the way";
        case placement_end::too_far:
            return too_far(*this);
        case placement_end::no_coordinates:
            return floats ? "rounded to float32 there is no such place"
                          : "there is no such place in coordinates that can be written";
        case placement_end::out_of_range:
            return std::string("is beyond the range of ") + (floats ? "float32" : "doubles") +
                   " at its place";
        case placement_end::cancelled:
            return "stopped by its caller";
        default:
            return certificate ? "" : "there is no such place";
    }
}

placement laid_flat::as_placement() const {
    placement at{.certificate = certificate,
                 .end = placement_end::bed,
                 .points = points,
                 .matrix = matrix,
                 .bed = bed,
                 .on_bed = true,
                 .at_place = standing::touching};
    if (contact) at.contacts = {*contact};
    at.contact_count = at.contacts.size();
    return at;
}

placement align_result::as_placement() const {
    return {.certificate = {.status = status}, .points = points, .matrix = matrix};
}

}  // namespace treeform
