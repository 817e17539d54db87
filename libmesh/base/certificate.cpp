#include <libmesh/base/operand_name.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/words.hpp>
#include <treeform/mesh/certificate.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform {
namespace {

using detail::base::brief;
using detail::base::counted;

std::string place_of(const point3& p) {
    std::string text = "(";
    for (std::size_t axis = 0; axis < 3; ++axis)
        text.append(axis == 0 ? "" : ", ").append(brief(p[axis]));
    return text + ")";
}

std::string open_message(const certificate& c) {
    std::string text = "its surface ";
    if (c.boundary_edges > 0) text += "ends at " + counted(c.boundary_edges, "edge", "edges");
    if (c.boundary_edges > 0 && c.misoriented_edges > 0) text += " and ";
    if (c.misoriented_edges > 0)
        text += "is inconsistently oriented at " + counted(c.misoriented_edges, "edge", "edges");
    if (c.boundary_edges == 0 && c.misoriented_edges == 0)
        text += "is open at " + counted(c.open_count, "edge", "edges");
    if (c.open_edges.empty()) return text;
    const auto& [from, to] = c.open_edges.front();
    const operand_element& face = c.open_faces.front();
    text += ", the first from " + place_of(from) + " to " + place_of(to) + " at face " +
            std::to_string(face.index);
    if (face.operand != operand_element::none)
        text += " of " + detail::base::operand_in_words(face.operand);
    return text;
}

std::string when_rounded(const certificate& c) {
    return c.precision == precision::float32 ? " when rounded to float" : " when rounded to double";
}

/// From the largest coordinate to the next float32.
double step_at(const point3& p) {
    const auto largest = static_cast<float>(detail::base::largest_of(p));
    return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity())) -
           static_cast<double>(largest);
}

std::string meeting_message(const certificate& c) {
    if (c.meeting_count == 0) return "a hole could not be closed";
    std::string text = counted(c.meeting_count, "pair of faces meets", "pairs of faces meet");
    if (c.max_displacement > 0.0) text += when_rounded(c);
    if (c.meeting_at.empty()) return text;
    text += ", the first near " + place_of(c.meeting_at[0]);
    if (c.precision == precision::float32 && c.max_displacement > 0.0)
        text += ", where float32 numbers are " + detail::base::brief(step_at(c.meeting_at[0])) +
                " apart; they are denser near the origin";
    return text;
}

std::string vanished_message(const certificate& c) {
    if (c.vanished_faces == 0) return "nothing would be left";
    return "nothing would be left: the whole exact result (" +
           counted(c.vanished_faces, "face", "faces") + ") is thinner than the spacing of " +
           (c.precision == precision::float32 ? "float32" : "double") + " numbers there";
}

std::string loss_message(const certificate& c) {
    if (c.size_before == 0.0) return "the loss would exceed the limit";
    return std::string("too much would be lost: the ") + (c.size_is_volume ? "volume" : "area") +
           " would fall from " + detail::base::brief(c.size_before) + " to " +
           detail::base::brief(c.size_after);
}

}  // namespace

std::string certificate::message() const {
    switch (status) {
        case treeform::status::ok:
            return "checked: all guarantees hold in the returned coordinates";
        case treeform::status::open_input:
            return open_message(*this);
        case treeform::status::sheet:
            return "a surface with a border, free of self-intersections";
        case treeform::status::excessive_loss:
            return loss_message(*this);
        case treeform::status::not_manifold:
            return "not a manifold once equal coordinates are joined";
        case treeform::status::not_certified:
            return meeting_message(*this);
        case treeform::status::vanished:
            return vanished_message(*this);
        case treeform::status::out_of_range:
            return "coordinates are too large" + when_rounded(*this);
        case treeform::status::no_placement:
            return "there is no valid placement";
        case treeform::status::cancelled:
            return "stopped by its caller";
    }
    return {};
}

not_certified_error::not_certified_error(certificate why)
    : std::runtime_error(why.message()), why_(std::move(why)) {}

not_certified_error::not_certified_error(certificate why, const std::string& message)
    : std::runtime_error(message.empty() ? why.message() : message), why_(std::move(why)) {}

}  // namespace treeform
