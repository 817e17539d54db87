#include <libmesh/attributes/known_columns.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace treeform {
namespace {

/// The cofactors of the linear part, which is how normals go; against them by a mirror, so that
/// what looked outward still does.
transform<3> of_normals(const transform<3>& m) {
    const double sign = m.mirrors() ? -1.0 : 1.0;
    transform<3> result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const auto& r = m.rows[(i + 1) % 3];
            const auto& s = m.rows[(i + 2) % 3];
            result.rows[i][j] =
                sign * (r[(j + 1) % 3] * s[(j + 2) % 3] - r[(j + 2) % 3] * s[(j + 1) % 3]);
        }
    return result;
}

bool only_shifts(const transform<3>& m) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (m.rows[i][j] != (i == j ? 1.0 : 0.0)) return false;
    return true;
}

bool holds_numbers(const column& c) {
    return !c.list_length && c.role == column_role::data &&
           (c.type == scalar_type::float32 || c.type == scalar_type::float64);
}

void set_number(column& c, std::size_t row, double value) {
    const auto put = [&](auto one) {
        std::memcpy(c.values.data() + row * sizeof(one), &one, sizeof(one));
    };
    if (c.type == scalar_type::float32)
        put(static_cast<float>(value));
    else
        put(value);
}

/// As long as before; as it was where the matrix leaves nothing of it.
point3 turned(const transform<3>& turn, const point3& n) {
    const point3 there = turn(n);
    const double before = std::hypot(n.x, n.y, n.z);
    const double after = std::hypot(there.x, there.y, there.z);
    if (!(after > 0.0)) return n;
    return {there.x / after * before, there.y / after * before, there.z / after * before};
}

void turn_columns(element& e, const transform<3>& turn) {
    std::array<column*, 3> axes{};
    for (column& c : e.columns)
        if (const auto axis = detail::attribute::normal_axis(c.name); axis && holds_numbers(c))
            axes[*axis] = &c;
    if (!axes[0] || !axes[1] || !axes[2]) return;
    for (std::size_t row = 0; row < e.rows; ++row) {
        point3 n;
        for (std::size_t k = 0; k < 3; ++k) n[k] = axes[k]->number(row);
        n = turned(turn, n);
        for (std::size_t k = 0; k < 3; ++k) set_number(*axes[k], row, n[k]);
    }
}

/// Faces, or numbers of their corners, with the second and the last corner of each polygon
/// exchanged and those between: it is a fan around its first corner, and stays one.
void turn_over(std::vector<face>& corners, const std::vector<std::uint32_t>& face_of_triangle) {
    for (face& f : corners) std::swap(f[1], f[2]);
    for (std::size_t first = 0, end = 0; first < face_of_triangle.size() && !corners.empty();
         first = end) {
        while (end < face_of_triangle.size() && face_of_triangle[end] == face_of_triangle[first])
            ++end;
        std::reverse(corners.begin() + static_cast<std::ptrdiff_t>(first),
                     corners.begin() + static_cast<std::ptrdiff_t>(end));
    }
}

}  // namespace

void mesh_file::move(const transform<3>& by) {
    for (point3& p : mesh.points) p = by(p);
    transform_normals(by);
    if (!by.mirrors()) return;
    corner_values& corners = attributes.corners;
    for (auto* const of_faces :
         {&mesh.faces, &corners.texture_of_corner, &corners.normal_of_corner})
        turn_over(*of_faces, face_of_triangle);
}

void mesh_file::transform_normals(const transform<3>& by) {
    if (only_shifts(by)) return;  // else last digits would change
    const transform<3> turn = of_normals(by);
    for (element& e : attributes.elements) turn_columns(e, turn);
    for (point3& n : attributes.corners.normals) n = turned(turn, n);
}

}  // namespace treeform
