#include <libmesh/boolean/detail/joined_operands.hpp>
#include <libmesh/detail/check_faces.hpp>
#include <libmesh/weld/equal_points.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

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

    equal_points equal = find_equal_points(all.points);
    for (std::size_t p = 0; p < equal.first_of_new.size(); ++p)
        all.points[p] = all.points[equal.first_of_new[p]];  // ascending: none is read too late
    all.points.resize(equal.first_of_new.size());
    for (face& f : all.faces)
        for (std::uint32_t& corner : f) corner = equal.new_of_old[corner];
    joined.number_of_point = std::move(equal.first_of_new);
    return joined;
}

}  // namespace tf::detail
