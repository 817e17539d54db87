#include <libmesh/weld/carried_rows.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::weld {
namespace {

[[noreturn]] void refuse(const std::string& why) {
    throw std::invalid_argument("treeform::weld: " + why);
}

void check_column(const element& e, const column& c) {
    if (c.role != column_role::data) return;
    const std::size_t values = c.size();
    const std::vector<std::uint64_t>& begin = c.list_begin;
    const bool fits = c.list_length
                          ? begin.size() == e.rows + 1 && begin.front() == 0 &&
                                begin.back() == values && std::is_sorted(begin.begin(), begin.end())
                          : values == e.rows;
    if (!fits) refuse("column '" + c.name + "' does not fit element '" + e.name + "'");
}

constexpr std::string_view names_of_points[] = {"vertex1", "vertex2", "vertex_index",
                                                "vertex_indices"};

void renumber_points(column& c, const std::vector<std::uint32_t>& new_of_old) {
    if (!numbers_points(c)) return;
    for_chunks(c.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        renumber(c, begin, end, new_of_old.size(),
                 [&](std::uint64_t old) { return new_of_old[static_cast<std::size_t>(old)]; });
    });
}

element carried(const element& e, const weld_result& welded) {
    if (e.name == "vertex") return e.gathered(welded.point_of_group);
    if (e.name == "face") return e.gathered(welded.face_of_new);
    element other = e;
    for (column& c : other.columns) renumber_points(c, welded.groups.group_of_point);
    return other;
}

}  // namespace

bool numbers_points(const column& c) {
    return c.role == column_role::data && c.type != scalar_type::float32 &&
           c.type != scalar_type::float64 &&
           std::ranges::find(names_of_points, c.name) != std::end(names_of_points);
}

void check_rows(const attributes& properties, std::size_t point_count, std::size_t face_count) {
    for (const element& e : properties.elements) {
        if (e.name == "vertex" && e.rows != point_count)
            refuse("element 'vertex' has " + std::to_string(e.rows) + " rows for " +
                   std::to_string(point_count) + " points");
        if (e.name == "face" && e.rows != face_count)
            refuse("element 'face' has " + std::to_string(e.rows) + " rows for " +
                   std::to_string(face_count) + " faces");
        for (const column& c : e.columns) check_column(e, c);
    }
    if (const auto fault = properties.corners.fault(face_count); !fault.empty()) refuse(fault);
}

attributes carry_rows(const attributes& properties, const weld_result& welded) {
    attributes result{.corners = properties.corners.gathered(welded.face_of_new),
                      .parts = properties.parts,
                      .material_files = properties.material_files,
                      .texture_files = properties.texture_files,
                      .comments = properties.comments,
                      .obj_info = properties.obj_info,
                      .header = properties.header};
    result.elements.reserve(properties.elements.size());
    for (const element& e : properties.elements) result.elements.push_back(carried(e, welded));
    const std::vector<std::uint32_t>& faces = welded.face_of_new;
    for (part& p : result.parts)
        p.first_face = static_cast<std::uint32_t>(
            std::lower_bound(faces.begin(), faces.end(), p.first_face) - faces.begin());
    return result;
}

}  // namespace treeform::detail::weld
