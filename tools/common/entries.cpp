#include "tools/common/entries.hpp"

#include "tools/common/console.hpp"
#include <treeform/tf.hpp>

namespace tools {

std::string in_words(const tf::point3& p) {
    return std::string("(").append(brief(p.x) + ", " + brief(p.y) + ", " + brief(p.z)) + ")";
}

const char* name_of(tf::precision precision) {
    return precision == tf::precision::float32 ? "float" : "double";
}

const char* numbers_of(tf::precision precision) {
    return precision == tf::precision::float32 ? "float32" : "double";
}

json open_entry(const tf::certificate& known, const face_numbers& stored_face) {
    json list = json::array();
    for (const tf::open_edge& edge : known.open)
        list.push_back(
            {{"face", stored_face(edge.face.index)}, {"from", edge.ends[0]}, {"to", edge.ends[1]}});
    const bool told = known.boundary_edges + known.misoriented_edges > 0 || known.open.empty();
    return {{"count", known.open_count},
            {"boundary_edges", or_null(told, known.boundary_edges)},
            {"misoriented_edges", or_null(told, known.misoriented_edges)},
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

std::string message_of(tf::certificate known, const face_numbers& stored_face) {
    for (tf::open_edge& edge : known.open)
        edge.face = {tf::operand_element::none, stored_face(edge.face.index)};
    return known.message();
}

}  // namespace tools
