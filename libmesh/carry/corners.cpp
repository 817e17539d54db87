#include <libmesh/base/point_math.hpp>
#include <libmesh/carry/carried.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace treeform::detail::carry {

namespace {

using base::cross;
using base::dot;
using base::minus;

constexpr std::uint32_t none = corner_values::none;

using texture_point = std::array<double, 3>;

/// The values of one kind that an input has.
template <class Row>
struct row_source {
    const std::vector<Row>& rows;
    const std::vector<face>& of_corner;
};

template <class Row>
row_source<Row> source_of(const attribute_source& input) {
    const corner_values& corners = input.file->attributes.corners;
    if constexpr (std::is_same_v<Row, point3>)
        return {corners.normals, corners.normal_of_corner};
    else
        return {corners.texture, corners.texture_of_corner};
}

/// Whether two numbers stand for one value.
template <class Row>
bool are_same(const std::vector<Row>& rows, std::uint32_t a, std::uint32_t b) {
    return a == b || (a != none && b != none && rows[a] == rows[b]);
}

/// Whether the corners of the triangle have one normal.
bool is_flat(const corner_values& corners, std::uint32_t triangle) {
    const face& numbers = corners.normal_of_corner[triangle];
    return numbers[0] != none && are_same(corners.normals, numbers[0], numbers[1]) &&
           are_same(corners.normals, numbers[0], numbers[2]);
}

texture_point seen(const texture_point& row, bool) { return row; }
point3 seen(const point3& n, bool turned) {
    return turned ? point3{0.0 - n.x, 0.0 - n.y, 0.0 - n.z} : n;  // no -0
}

texture_point between(const texture_point& sum) { return sum; }
point3 between(const point3& sum) { return with_length_one(sum); }

/// Where a corner of the result is in the face of an input that it comes from.
struct place_in_face {
    std::size_t corner = 3;  ///< at this corner of it; 3: at none
    std::array<double, 3> shares{};
};

/// The same for both faces at the edge from corner `i` to corner `j`, so that they still share what
/// is in between.
std::array<double, 3> shares_along_edge(const point3& p, const std::array<point3, 3>& at,
                                        std::size_t i, std::size_t j) {
    if (std::tie(at[j].x, at[j].y, at[j].z) < std::tie(at[i].x, at[i].y, at[i].z)) std::swap(i, j);
    std::array<double, 3> shares{};
    shares[j] = share_along(p, at[i], at[j]);
    shares[i] = 1.0 - shares[j];
    return shares;
}

place_in_face place_of(const point3& p, const mesh& mesh, const face& corners) {
    std::array<point3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
        at[k] = mesh.points[corners[k]];
        if (at[k] == p) return {.corner = k};
    }
    const std::array<double, 3> shares = shares_at(p, at[0], at[1], at[2]).of;
    // Far below what textures hold, and far above what rounding does.
    constexpr double on_edge = 0x1p-44;
    for (std::size_t k = 0; k < 3; ++k)
        if (shares[k] <= on_edge)
            return {.shares = shares_along_edge(p, at, (k + 1) % 3, (k + 2) % 3)};
    return {.shares = shares};
}

/// A point as it was before it was rounded, where it is one of an input.
const point3& place_before(std::span<const attribute_source> inputs, const mesh& surface,
                           const carried_elements& made, std::uint32_t p) {
    const operand_element source = made.vertex_source[p];
    return source == operand_element{} ? surface.points[p]
                                       : inputs[source.operand].file->mesh.points[source.index];
}

/// Values of one kind on their way to the result.
template <class Row>
class row_carrier {
  public:
    row_carrier(std::span<const attribute_source> inputs, std::size_t points) : made_(points) {
        for (const attribute_source& input : inputs) {
            sources_.push_back(source_of<Row>(input));
            copies_.push_back({});
            for (auto& copies : copies_.back()) copies.assign(sources_.back().rows.size(), none);
        }
    }

    /// What the corners of the input's triangle have.
    [[nodiscard]] face numbers_of(std::uint32_t input, std::uint32_t triangle) const {
        const std::vector<face>& all = sources_[input].of_corner;
        return all.empty() ? face{none, none, none} : all[triangle];
    }

    /// The number in the result of what stands at a place of that face.
    [[nodiscard]] std::uint32_t carry(std::uint32_t p, operand_element source, bool turned,
                                      const face& numbers, const place_in_face& place) {
        if (place.corner < 3) return copy(source.operand, turned, numbers[place.corner]);
        for (std::size_t k = 0; k < 3; ++k)
            if (place.shares[k] == 1.0) return copy(source.operand, turned, numbers[k]);
        if (numbers[0] == numbers[1] && numbers[1] == numbers[2])
            return copy(source.operand, turned, numbers[0]);
        Row sum{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (!(place.shares[k] > 0.0)) continue;
            if (numbers[k] == none) return none;
            const Row& row = sources_[source.operand].rows[numbers[k]];
            for (std::size_t i = 0; i < 3; ++i) sum[i] += place.shares[k] * row[i];
        }
        return add(p, source, turned, seen(between(sum), turned));
    }

    /// The number in the result of what a corner of a simplified surface has, given the face of the
    /// input that it is in.
    [[nodiscard]] std::uint32_t carry_simplified(std::uint32_t p, std::uint32_t triangle,
                                                 const place_in_face& place) {
        return carry(p, {0, triangle}, false, numbers_of(0, triangle), place);
    }
    /// The number in the result of a new value.
    [[nodiscard]] std::uint32_t append(const Row& row) {
        rows_.push_back(row);
        return static_cast<std::uint32_t>(rows_.size() - 1);
    }

    [[nodiscard]] std::vector<Row>& rows() { return rows_; }

  private:
    /// The last row that was made at a point, and for which face.
    struct made_row {
        operand_element face{};
        bool turned = false;
        std::uint32_t number = none;
    };

    [[nodiscard]] std::uint32_t copy(std::uint32_t input, bool turned, std::uint32_t number) {
        if (number == none) return none;
        constexpr bool can_turn = std::is_same_v<Row, point3>;
        std::uint32_t& there = copies_[input][can_turn && turned ? 1 : 0][number];
        if (there == none) there = append(seen(sources_[input].rows[number], turned));
        return there;
    }

    [[nodiscard]] std::uint32_t add(std::uint32_t p, operand_element face, bool turned,
                                    const Row& row) {
        made_row& last = made_[p];
        const bool known = last.number != none && ((last.face == face && last.turned == turned) ||
                                                   rows_[last.number] == row);
        last = {face, turned, known ? last.number : append(row)};
        return last.number;
    }

    std::vector<row_source<Row>> sources_{};
    /// By input, as they are and turned around: the number in the result of each row, or none.
    std::vector<std::array<std::vector<std::uint32_t>, 2>> copies_{};
    std::vector<made_row> made_;  ///< [V]
    std::vector<Row> rows_{};
};

/// Gives corner `k` of face `f` of a simplified surface its value.
template <class Row>
std::uint32_t simplified(row_carrier<Row>& carrier, const attribute_source& input,
                         const mesh& surface, const carried_elements& made, std::size_t f,
                         std::size_t k) {
    if (const std::uint32_t corner = made.corner_source[3 * f + k]; corner != none)
        return carrier.carry_simplified(surface.faces[f][k], input.triangle(corner / 3),
                                        {.corner = corner % 3});
    const std::uint32_t p = surface.faces[f][k], in = made.face_of_cut_vertex[p].index;
    const mesh& mesh = input.file->mesh;
    return carrier.carry_simplified(p, input.triangle(in),
                                    place_of(surface.points[p], mesh, mesh.faces[in]));
}

/// [F] the numbers of the corners of the result; empty where no input has such values.
template <class Row>
std::vector<face> carried(std::span<const attribute_source> inputs, const mesh& surface,
                          const carried_elements& made, std::vector<Row>& rows) {
    const bool any = std::any_of(inputs.begin(), inputs.end(), [](const attribute_source& input) {
        return !source_of<Row>(input).of_corner.empty();
    });
    if (!any) return {};
    row_carrier<Row> carrier(inputs, surface.points.size());
    std::vector<face> all(surface.faces.size(), {none, none, none});
    for (std::size_t f = 0; f < all.size(); ++f) {
        const operand_element source = made.face_source[f];
        if (source == operand_element{}) continue;
        const attribute_source& input = inputs[source.operand];
        const face numbers = carrier.numbers_of(source.operand, input.triangle(source.index));
        if (numbers == face{none, none, none}) continue;
        if (!made.corner_source.empty()) {
            if constexpr (std::is_same_v<Row, point3>)
                if (is_flat(input.file->attributes.corners, input.triangle(source.index))) {
                    all[f].fill(
                        carrier.append(with_length_one(normal_of(surface, surface.faces[f]))));
                    continue;
                }
            for (std::size_t k = 0; k < 3; ++k)
                all[f][k] = simplified(carrier, input, surface, made, f, k);
            continue;
        }
        const mesh& mesh = input.file->mesh;
        const face& corners = mesh.faces[source.index];
        const bool turned =
            is_turned(normal_of(surface, surface.faces[f]), normal_of(mesh, corners));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = surface.faces[f][k];
            const auto place = place_of(place_before(inputs, surface, made, p), mesh, corners);
            all[f][k] = carrier.carry(p, source, turned, numbers, place);
        }
    }
    rows = std::move(carrier.rows());
    return rows.empty() ? std::vector<face>{} : all;
}

/// The list of a PLY that texture coordinates are to be written to, so that doubles stay doubles;
/// null where floats will do.
const column* double_list(std::span<const attribute_source> inputs) {
    for (const attribute_source& input : inputs)
        if (const element* faces = input.file->attributes.find("face"))
            for (const column& c : faces->columns)
                if (c.role == column_role::texture && c.type == scalar_type::float64) return &c;
    return nullptr;
}

}  // namespace

shares_of_corners shares_at(const point3& p, const point3& a, const point3& b, const point3& c) {
    const point3 normal = cross(minus(b, a), minus(c, a));
    const point3 to_a = minus(a, p), to_b = minus(b, p), to_c = minus(c, p);
    std::array<double, 3> w{dot(normal, cross(to_b, to_c)), dot(normal, cross(to_c, to_a)),
                            dot(normal, cross(to_a, to_b))};
    double sum = 0.0, outside = 0.0;
    for (double& one : w) {
        outside += std::max(-one, 0.0);
        sum += one = std::max(one, 0.0);
    }
    if (!(sum > 0.0) || !std::isfinite(sum) || !std::isfinite(outside)) return {};
    for (double& one : w) one /= sum;
    return {w, outside / sum};
}

double share_along(const point3& p, const point3& a, const point3& b) {
    const point3 edge = minus(b, a);
    const double share = dot(minus(p, a), edge) / dot(edge, edge);
    return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

point3 normal_of(const mesh& mesh, const face& f) {
    const point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
    return cross(minus(b, a), minus(c, a));
}

point3 with_length_one(const point3& v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0.0 ? point3{v.x / length, v.y / length, v.z / length} : v;
}

bool is_turned(const point3& normal, const point3& other) { return dot(normal, other) < 0.0; }

void carry_corners(mesh_file& file, std::span<const attribute_source> inputs,
                   const carried_elements& made) {
    corner_values& corners = file.attributes.corners;
    corners.texture_of_corner = carried(inputs, file.mesh, made, corners.texture);
    if (const column* list = double_list(inputs); list && !corners.texture_of_corner.empty())
        file.attributes.find_or_add("face", file.mesh.faces.size()).columns.push_back(*list);
    corners.normal_of_corner = carried(inputs, file.mesh, made, corners.normals);
    corners.has_w = std::any_of(inputs.begin(), inputs.end(), [](const attribute_source& input) {
        return input.file->attributes.corners.has_w;
    });
}

bool look_alike(const corner_values& corners, const std::array<std::uint32_t, 2>& triangles,
                const std::array<std::array<std::size_t, 2>, 2>& at_ends) {
    const auto same = [&](const auto& rows, const std::vector<face>& of_corner) {
        return of_corner.empty() || std::ranges::all_of(at_ends, [&](const auto& end) {
                   return are_same(rows, of_corner[triangles[0]][end[0]],
                                   of_corner[triangles[1]][end[1]]);
               });
    };
    return same(corners.texture, corners.texture_of_corner) &&
           (same(corners.normals, corners.normal_of_corner) ||
            (is_flat(corners, triangles[0]) && is_flat(corners, triangles[1])));
}

}  // namespace treeform::detail::carry
