#include <libmesh/base/operand_name.hpp>
#include <treeform/mesh/certificate.hpp>

#include <cstdio>
#include <utility>

namespace treeform {
namespace {

std::string counted(std::uint64_t n, const char* one, const char* several) {
    return std::to_string(n) + " " + (n == 1 ? one : several);
}

std::string place_of(const point3& p) {
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
    return text;
}

std::string open_message(const certificate& c) {
    std::string text = "not closed: " + counted(c.open_count, "open edge", "open edges");
    if (c.open.empty()) return text;
    const open_edge& first = c.open.front();
    return text + ", the first at face " + std::to_string(first.face.index) + " of operand " +
           detail::base::operand_name(first.face.operand) + ", from " + place_of(first.ends[0]) +
           " to " + place_of(first.ends[1]);
}

}  // namespace

std::string certificate::message() const {
    switch (status) {
        case treeform::status::ok:
            return "checked: all that was promised holds in the coordinates returned";
        case treeform::status::open_input:
            return open_message(*this);
        case treeform::status::sheet:
            return "a surface with a border, free of self-intersections";
        case treeform::status::excessive_loss:
            return "more of the input would be lost than is allowed";
        case treeform::status::not_manifold:
            return "not a manifold once equal coordinates are joined";
        case treeform::status::not_certified:
            return counted(meeting_count, "pair of faces still meets",
                           "pairs of faces still meet") +
                   " in the coordinates of the result";
        case treeform::status::vanished:
            return "nothing is left: the result is thinner than its coordinates can tell apart, or "
                   "its "
                   "faces cancel each other out";
        case treeform::status::out_of_range:
            return "coordinates of the result are beyond the range of the numbers asked for";
        case treeform::status::no_place:
            return "there is no such place";
        case treeform::status::cancelled:
            return "stopped by its caller";
    }
    return {};
}

not_certified_error::not_certified_error(certificate why)
    : std::runtime_error(why.message()), why_(std::move(why)) {}

}  // namespace treeform
