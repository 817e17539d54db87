#include "tools/shell/entries.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/made/report_fields.hpp"
#include <treeform/tf.hpp>

#include <cstddef>

namespace tools {
namespace {

/// Whether lists and objects are in each other at most `most` deep.
bool is_shallow(const json& value, std::size_t most) {
    if (!value.is_structured() || value.empty()) return true;
    if (most == 0) return false;
    for (const json& inside : value)
        if (!is_shallow(inside, most - 1)) return false;
    return true;
}

std::string compact(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

void lay_out(const json& value, bool in_list, const std::string& indentation, std::string& text) {
    if (is_shallow(value, in_list ? 2 : value.is_array() ? 1 : 0)) {
        text += compact(value);
        return;
    }
    const std::string inner = indentation + " ";
    char before = value.is_array() ? '[' : '{';
    for (const auto& [key, inside] : value.items()) {
        text += before;
        text += '\n';
        text += inner;
        if (value.is_object()) text += compact(json(key)) + ": ";
        lay_out(inside, value.is_array(), inner, text);
        before = ',';
    }
    text += '\n';
    text += indentation;
    text += value.is_array() ? ']' : '}';
}

}  // namespace

std::string in_words(const tf::point3& p) {
    return std::string("(").append(brief(p.x) + ", " + brief(p.y) + ", " + brief(p.z)) + ")";
}

const char* name_of(tf::precision precision) {
    return precision == tf::precision::float32 ? "float" : "double";
}

const char* numbers_of(tf::precision precision) {
    return precision == tf::precision::float32 ? "float32" : "double";
}

json open_entry(const tf::certificate& known, const face_numbers& face_in_file) {
    json list = json::array();
    for (std::size_t i = 0; i < known.open_edges.size(); ++i)
        list.push_back({{"face", face_in_file(known.open_faces[i].index)},
                        {"from", known.open_edges[i][0]},
                        {"to", known.open_edges[i][1]}});
    const bool known_edges =
        known.boundary_edges + known.misoriented_edges > 0 || known.open_edges.empty();
    return {{"count", known.open_count},
            {"boundary_edges", or_null(known_edges, known.boundary_edges)},
            {"misoriented_edges", or_null(known_edges, known.misoriented_edges)},
            {"list", list}};
}

json meeting_entry(const tf::certificate& known) {
    json list = json::array();
    for (std::size_t i = 0; i < known.meeting_at.size(); ++i)
        list.push_back({{"faces", known.meeting[i]}, {"near", known.meeting_at[i]}});
    return list;
}

json loss_entry(const tf::certificate& known) {
    if (known.status != tf::status::excessive_loss) return nullptr;
    return {{"of", known.size_is_volume ? "volume" : "area"},
            {"before", known.size_before},
            {"after", known.size_after}};
}

json steps_entry(const tf::repair_statistics& did, const tf::repair_options& steps) {
    return {{"join", or_null(steps.join, join_entry(did))},
            {"orient", or_null(steps.orient, orient_entry(did))},
            {"fill", or_null(steps.fill && !steps.sheet, fill_entry(did))},
            {"resolve", or_null(steps.resolve, cut_entry(did))},
            {"detach", or_null(steps.detach, detach_entry(did))}};
}

std::string repair_summary(const tf::repair_statistics& did) {
    const std::string text = did.message();
    return text.empty() ? "nothing to repair" : text;
}

std::string message_of(tf::certificate known, const face_numbers& face_in_file) {
    for (tf::operand_element& face : known.open_faces)
        face = {tf::operand_element::none, face_in_file(face.index)};
    return known.message();
}

std::string report_text(const json& report) {
    std::string text;
    lay_out(report, false, {}, text);
    return text + '\n';
}

}  // namespace tools
