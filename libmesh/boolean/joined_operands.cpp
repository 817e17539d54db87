#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/operand_name.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::boolean {
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
        throw std::invalid_argument("treeform::" + std::string(function) + ": 2^32 - 1 " + what +
                                    " or more");
}

void renumber(std::vector<face>& faces, const std::vector<std::uint32_t>& new_of_old) {
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            for (std::uint32_t& corner : faces[f]) corner = new_of_old[corner];
    });
}

/// All points and faces, one operand after the other.
void append_all(std::span<const mesh_view> operands, joined_operands& joined) {
    mesh& all = joined.all;
    std::size_t point = 0, face_number = 0;
    for (std::uint32_t k = 0; k < operands.size(); ++k) {
        const mesh_view& operand = operands[k];
        joined.first_point.push_back(static_cast<std::uint32_t>(point));
        joined.first_face.push_back(static_cast<std::uint32_t>(face_number));
        for_chunks(operand.points.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t p = begin; p < end; ++p)
                           all.points[point + p] = operand.points[p];
                   });
        const auto offset = static_cast<std::uint32_t>(point);
        for_chunks(operand.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f) {
                           const auto& [a, b, c] = operand.faces[f];
                           all.faces[face_number + f] = {a + offset, b + offset, c + offset};
                       }
                   });
        point += operand.points.size();
        face_number += operand.faces.size();
    }
    joined.first_point.push_back(static_cast<std::uint32_t>(point));
    joined.first_face.push_back(static_cast<std::uint32_t>(face_number));
}

/// Leaves out points that no face uses, which may be anything, also NaN.
void keep_used(joined_operands& joined) {
    mesh& all = joined.all;
    std::vector<std::uint32_t> used = base::used_points(all.points.size(), all.faces);
    if (used.size() == all.points.size()) return;
    std::vector<std::uint32_t> new_of_old(all.points.size(), 0);
    for (std::uint32_t i = 0; i < used.size(); ++i) {
        new_of_old[used[i]] = i;
        all.points[i] = all.points[used[i]];
    }
    all.points.resize(used.size());
    renumber(all.faces, new_of_old);
    joined.number_of_point = std::move(used);
}

void join_equal(joined_operands& joined) {
    mesh& all = joined.all;
    const auto equal = weld::few_equal_points(all.points);
    if (!equal) return;
    const std::size_t count = equal->first_of_group.size();
    std::vector<std::uint32_t> number = equal->first_of_group;
    for (std::size_t i = 0; i < count; ++i) {
        all.points[i] = all.points[number[i]];
        if (!joined.number_of_point.empty()) number[i] = joined.number_of_point[number[i]];
    }
    all.points.resize(count);
    joined.number_of_point = std::move(number);
    renumber(all.faces, equal->group_of_point);
}

}  // namespace

operand_element joined_operands::face_source(std::uint32_t face) const {
    return element_at(first_face, number_of_face.empty() ? face : number_of_face[face]);
}

operand_element joined_operands::point_source(std::uint32_t point) const {
    return element_at(first_point, number_of_point.empty() ? point : number_of_point[point]);
}

std::vector<std::uint32_t> joined_operands::operand_of_face() const {
    std::vector<std::uint32_t> operands(first_face.back());
    for (std::uint32_t k = 0; k + 1 < first_face.size(); ++k)
        std::fill(operands.begin() + first_face[k], operands.begin() + first_face[k + 1], k);
    for (std::size_t f = 0; f < number_of_face.size(); ++f)
        operands[f] = operands[number_of_face[f]];
    if (!number_of_face.empty()) operands.resize(number_of_face.size());
    return operands;
}

namespace {

/// "unite: operand b", or the function alone where it has one operand.
std::string name_in(const char* function, std::span<const mesh_view> operands,
                    const mesh_view& operand) {
    if (operands.size() == 1) return function;
    return std::string(function) + ": " +
           base::operand_in_words(static_cast<std::size_t>(&operand - operands.data()));
}

}  // namespace

void check_coordinates(const char* function, std::span<const mesh_view> operands) {
    for (const mesh_view& operand : operands)
        for (std::size_t f = 0; f < operand.faces.size(); ++f)
            for (const std::uint32_t corner : operand.faces[f])
                for (std::size_t k = 0; k < 3; ++k)
                    if (!(std::abs(operand.points[corner][k]) <= 0x1p1000))
                        throw std::invalid_argument(
                            "treeform::" + name_in(function, operands, operand) + ": face " +
                            std::to_string(f) +
                            " has a corner that is not finite or beyond 2^1000");
}

void check_operands(const char* function, std::span<const mesh_view> operands) {
    std::size_t points = 0, faces = 0;
    for (const mesh_view& operand : operands) {
        const std::string name = name_in(function, operands, operand);
        base::check_faces(name.c_str(), operand.points.size(), operand.faces);
        if (operand.faces.empty() && !operand.points.empty())
            throw std::invalid_argument("treeform::" + name + ": a point cloud is no operand");
        points += operand.points.size();
        faces += operand.faces.size();
    }
    require_nameable(function, points, "points");
    require_nameable(function, faces, "faces");
    require_nameable(function, operands.size(), "operands");
}

joined_operands join_operands(std::span<const mesh_view> operands) {
    joined_operands joined;
    std::size_t points = 0, faces = 0;
    for (const mesh_view& operand : operands) {
        points += operand.points.size();
        faces += operand.faces.size();
    }
    base::parallel_invoke([&] { base::resize_all(points, joined.all.points); },
                          [&] { base::resize_all(faces, joined.all.faces); });
    append_all(operands, joined);
    keep_used(joined);
    join_equal(joined);
    return joined;
}

joined_operands part_of(const joined_operands& joined, std::span<const std::uint32_t> faces) {
    joined_operands part{{}, joined.first_face, joined.first_point, joined.number_of_point, {}};
    part.all.faces.resize(faces.size());
    part.number_of_face.resize(faces.size());
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            part.all.faces[i] = joined.all.faces[faces[i]];
            part.number_of_face[i] =
                joined.number_of_face.empty() ? faces[i] : joined.number_of_face[faces[i]];
        }
    });
    const std::vector<std::uint32_t> used =
        base::used_points(joined.all.points.size(), part.all.faces);
    std::vector<std::uint32_t> new_of_old(joined.all.points.size(), 0);
    part.all.points.resize(used.size());
    part.number_of_point.resize(used.size());
    for (std::uint32_t i = 0; i < used.size(); ++i) {
        const std::uint32_t p = used[i];
        new_of_old[p] = i;
        part.all.points[i] = joined.all.points[p];
        part.number_of_point[i] = joined.number_of_point.empty() ? p : joined.number_of_point[p];
    }
    renumber(part.all.faces, new_of_old);
    return part;
}

}  // namespace treeform::detail::boolean
