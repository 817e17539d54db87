#include <libmesh/boolean/detail/joined_operands.hpp>
#include <libmesh/detail/check_faces.hpp>
#include <libmesh/weld/equal_points.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace tf::detail {
namespace {

/// Of an ascending list of where runs begin, the last that is not beyond `number`; empty runs begin
/// where the next one does.
operand_element element_at(const std::vector<std::uint32_t>& first, std::uint32_t number) {
    const auto next = std::upper_bound(first.begin(), first.end(), number);
    const auto operand = static_cast<std::uint32_t>(next - first.begin() - 1);
    return {operand, number - first[operand]};
}

void require_nameable(const char* function, std::size_t count, const char* what) {
    if (count >= operand_element::none)
        throw std::invalid_argument("tf::" + std::string(function) + ": 2^32 - 1 " + what +
                                    " or more");
}

/// Ascending.
std::vector<std::uint32_t> used_points(mesh_view mesh) {
    std::vector<std::uint8_t> used(mesh.points.size(), 0);
    for (const face& f : mesh.faces)
        for (const std::uint32_t corner : f) used[corner] = 1;
    std::vector<std::uint32_t> points;
    for (std::uint32_t p = 0; p < used.size(); ++p)
        if (used[p] != 0) points.push_back(p);
    return points;
}

}  // namespace

operand_element joined_operands::face_source(std::uint32_t face) const {
    return element_at(first_face, face);
}

operand_element joined_operands::point_source(std::uint32_t point) const {
    return element_at(first_point, number_of_point[point]);
}

joined_operands join_operands(const char* function, std::span<const mesh_view> operands) {
    joined_operands joined;
    std::size_t points = 0, faces = 0;
    for (const mesh_view& operand : operands) {
        check_faces(function, operand.points.size(), operand.faces);
        points += operand.points.size();
        faces += operand.faces.size();
    }
    require_nameable(function, points, "points");
    require_nameable(function, faces, "faces");
    require_nameable(function, operands.size(), "operands");

    mesh& all = joined.all;
    all.points.reserve(points);
    all.faces.reserve(faces);
    joined.operand_of_face.reserve(faces);
    for (std::uint32_t k = 0; k < operands.size(); ++k) {
        const auto offset = static_cast<std::uint32_t>(all.points.size());
        joined.first_point.push_back(offset);
        joined.first_face.push_back(static_cast<std::uint32_t>(all.faces.size()));
        all.points.insert(all.points.end(), operands[k].points.begin(), operands[k].points.end());
        for (const auto& [a, b, c] : operands[k].faces)
            all.faces.push_back({a + offset, b + offset, c + offset});
        joined.operand_of_face.resize(all.faces.size(), k);
    }
    joined.first_point.push_back(static_cast<std::uint32_t>(points));
    joined.first_face.push_back(static_cast<std::uint32_t>(faces));

    // Points that no face uses may be anything, also NaN, and are left out.
    const std::vector<std::uint32_t> used = used_points(all);
    std::vector<std::uint32_t> new_of_old(points, 0);
    std::vector<point3> corners;
    corners.reserve(used.size());
    for (const std::uint32_t p : used) corners.push_back(all.points[p]);
    const equal_points equal = find_equal_points(corners);
    for (std::size_t i = 0; i < used.size(); ++i) new_of_old[used[i]] = equal.new_of_old[i];
    all.points.clear();
    joined.number_of_point.reserve(equal.first_of_new.size());
    for (const std::uint32_t first : equal.first_of_new) {
        all.points.push_back(corners[first]);
        joined.number_of_point.push_back(used[first]);
    }
    for (face& f : all.faces)
        for (std::uint32_t& corner : f) corner = new_of_old[corner];
    return joined;
}

}  // namespace tf::detail
