#include <libmesh/carry/carried.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

namespace treeform::detail::carry {
namespace {

bool is_normal(const std::string& name) { return name == "nx" || name == "ny" || name == "nz"; }

/// Whether points have all three coordinates of a normal; they are carried together.
bool has_normals(const element& e) {
    return e.name == "vertex" && e.find("nx") != nullptr && e.find("ny") != nullptr &&
           e.find("nz") != nullptr;
}

bool can_be_carried(const column& c) { return c.role == column_role::data && !c.list_length; }

bool is_single_value(const element& e, const column& c) {
    return can_be_carried(c) && !(has_normals(e) && is_normal(c.name));
}

template <class T>
T nearest(double value) {
    if constexpr (std::is_floating_point_v<T>)
        return static_cast<T>(value);
    else if (std::isnan(value))
        return T{0};
    else
        return static_cast<T>(std::nearbyint(value));
}

/// `value_of(row)` for each row, in a column like `p`.
template <class ValueOf>
column make_values(const property& p, std::size_t rows, ValueOf value_of) {
    return with_type(p.type, [&]<class T>(T) {
        return io::column_of<T>(p.name, rows,
                                [&](std::size_t row) { return nearest<T>(value_of(row)); });
    });
}

/// The input points that a point of the result has its values from.
struct mixture {
    std::uint32_t input = 0;
    face points{};
    shares_of_corners shares{};
};

/// Between the corners of a face of an input.
mixture mixture_at(const point3& p, std::span<const attribute_source> inputs,
                   const operand_element& in) {
    const mesh& mesh = inputs[in.operand].file->mesh;
    const face& corners = mesh.faces[in.index];
    return {
        in.operand, corners,
        shares_at(p, mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]])};
}

std::vector<mixture> mixtures_of(std::span<const attribute_source> inputs, const mesh& surface,
                                 const carried_elements& made) {
    std::vector<mixture> all(surface.points.size());
    std::vector<std::uint8_t> known(all.size(), 0);
    for (std::size_t p = 0; p < all.size(); ++p) {
        const operand_element source = made.vertex_source[p];
        if (source != operand_element{})
            all[p] = {source.operand, {source.index, source.index, source.index}};
        else if (!made.face_of_cut_vertex.empty() &&
                 made.face_of_cut_vertex[p] != operand_element{})
            all[p] = mixture_at(surface.points[p], inputs, made.face_of_cut_vertex[p]);
        else
            continue;
        known[p] = 1;
    }
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        for (const std::uint32_t p : surface.faces[f]) {
            // Where rounding was mended, a face can reach beyond its source: then another one may
            // do. Else the first, for what a corner is given does not hang on the last digits.
            constexpr double enough = 1e-9;
            if (known[p] != 0 && all[p].shares.outside <= enough) continue;
            if (made.face_source[f] == operand_element{}) continue;
            const mixture m = mixture_at(surface.points[p], inputs, made.face_source[f]);
            if (known[p] == 0 || m.shares.outside < all[p].shares.outside) all[p] = m;
            known[p] = 1;
        }
    return all;
}

double value_of(const property& p, const mixture& m) {
    const column* values = p.of_input[m.input];
    if (values == nullptr) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        if (m.shares.of[k] > 0.0) sum += m.shares.of[k] * values->number(m.points[k]);
    return sum;
}

/// The normal of a point where face `f` of the surface has it.
point3 carried_normal(std::span<const attribute_source> inputs, const mesh& surface,
                      const carried_elements& made, const mixture& m, std::uint32_t f) {
    const element* points = inputs[m.input].file->attributes.find("vertex");
    const point3 flat = normal_of(surface, surface.faces[f]);
    if (points == nullptr || !has_normals(*points)) return with_length_one(flat);
    point3 normal{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const column& c = *points->find(std::array{"nx", "ny", "nz"}[axis]);
        for (std::size_t k = 0; k < 3; ++k)
            if (m.shares.of[k] > 0.0) normal[axis] += m.shares.of[k] * c.number(m.points[k]);
    }
    if (m.shares.of[0] < 1.0) normal = with_length_one(normal);
    const operand_element source = made.face_source[f];
    if (source.operand != m.input) return normal;
    const mesh& mesh = inputs[m.input].file->mesh;
    const bool turned = is_turned(flat, normal_of(mesh, mesh.faces[source.index]));
    return turned ? point3{-normal.x, -normal.y, -normal.z} : normal;
}

/// A point's normal is seen from the lowest of its faces that come from the same input as the
/// point, or else from the lowest.
void carry_normals(element& rows, std::span<const attribute_source> inputs, const mesh& surface,
                   const carried_elements& made, const std::vector<mixture>& mixtures) {
    constexpr auto none = operand_element::none;
    std::vector<std::uint32_t> seen_from(surface.points.size(), none);
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
        for (const std::uint32_t p : surface.faces[f]) {
            const auto is_own = [&](std::uint32_t face) {
                return made.face_source[face].operand == mixtures[p].input;
            };
            if (seen_from[p] == none || (!is_own(seen_from[p]) && is_own(f))) seen_from[p] = f;
        }
    std::array<std::vector<float>, 3> values;
    for (std::uint32_t p = 0; p < seen_from.size(); ++p) {
        point3 normal{};
        if (seen_from[p] != none)
            normal = carried_normal(inputs, surface, made, mixtures[p], seen_from[p]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            values[axis].push_back(static_cast<float>(normal[axis]));
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        rows.columns.push_back(column::of<float>(std::array{"nx", "ny", "nz"}[axis], values[axis]));
}

bool any_has_normals(std::span<const attribute_source> inputs) {
    return std::any_of(inputs.begin(), inputs.end(), [](const attribute_source& s) {
        const element* points = s.file->attributes.find("vertex");
        return points != nullptr && has_normals(*points);
    });
}

}  // namespace

std::vector<property> properties_of(std::span<const attribute_source> inputs, const char* name) {
    std::vector<property> all;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        const element* e = inputs[k].file->attributes.find(name);
        if (e == nullptr) continue;
        for (const column& c : e->columns) {
            if (!is_single_value(*e, c)) continue;
            auto at = std::ranges::find(all, c.name, &property::name);
            if (at == all.end()) {
                all.push_back({c.name, c.type, {}});
                all.back().of_input.resize(inputs.size(), nullptr);
                at = all.end() - 1;
            }
            if (at->type != c.type) at->type = scalar_type::float64;
            at->of_input[k] = &c;
        }
    }
    return all;
}

}  // namespace treeform::detail::carry

namespace treeform {

using namespace detail::carry;  // NOLINT: their public half

namespace {

void carry_all(mesh_file& file, const attribute_sources& sources, const carried_elements& made) {
    const std::span<const attribute_source> inputs = sources.all();
    const mesh& surface = file.mesh;
    if (const auto of_points = properties_of(inputs, "vertex"); sources.has_vertex_values()) {
        const std::vector<mixture> mixtures = mixtures_of(inputs, surface, made);
        element& rows = file.attributes.find_or_add("vertex", surface.points.size());
        for (const property& p : of_points)
            rows.columns.push_back(make_values(
                p, mixtures.size(), [&](std::size_t row) { return value_of(p, mixtures[row]); }));
        if (any_has_normals(inputs)) carry_normals(rows, inputs, surface, made, mixtures);
    }
    if (const auto of_faces = properties_of(inputs, "face"); !of_faces.empty()) {
        element& rows = file.attributes.find_or_add("face", surface.faces.size());
        for (const property& p : of_faces)
            rows.columns.push_back(make_values(p, surface.faces.size(), [&](std::size_t row) {
                const auto [operand, index] = made.face_source[row];
                const column* values =
                    operand == operand_element::none ? nullptr : p.of_input[operand];
                return values == nullptr ? std::numeric_limits<double>::quiet_NaN()
                                         : values->number(inputs[operand].face_in_file(index));
            }));
    }
    carry_corners(file, inputs, made);
    carry_materials(file, inputs, made);
}

}  // namespace

void attribute_sources::transfer(mesh_file& file, std::span<const operand_element> face_source,
                                 std::span<const operand_element> vertex_source,
                                 std::span<const operand_element> face_of_cut_vertex) const {
    carry_all(file, *this, {face_source, vertex_source, face_of_cut_vertex});
}

void attribute_sources::transfer(mesh_file& file, std::span<const std::uint32_t> face_source,
                                 std::span<const std::uint32_t> vertex_source,
                                 std::span<const std::uint32_t> face_of_new_vertex,
                                 std::span<const std::uint32_t> corner_source) const {
    const auto of_input = [](std::span<const std::uint32_t> indices) {
        std::vector<operand_element> elements(indices.size());
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices[i] != operand_element::none) elements[i] = {0, indices[i]};
        return elements;
    };
    const std::vector<operand_element> faces = of_input(face_source);
    const std::vector<operand_element> vertices = of_input(vertex_source);
    const std::vector<operand_element> cut = of_input(face_of_new_vertex);
    carry_all(file, *this, {faces, vertices, cut, corner_source});
}

bool attribute_sources::has_vertex_values() const {
    return any_has_normals(all_) || !properties_of(all_, "vertex").empty();
}

bool attribute_sources::merging_mixes_values() const {
    if (has_vertex_values()) return true;
    const std::vector<std::uint32_t> groups = face_groups(true, false);
    return std::ranges::adjacent_find(groups, std::ranges::not_equal_to{}) != groups.end();
}

bool attribute_sources::has_values_left_out() const {
    for (const attribute_source& input : all_)
        for (const element& e : input.file->attributes.elements)
            for (const column& c : e.columns)
                if (c.role == column_role::data &&
                    ((e.name != "vertex" && e.name != "face") || !can_be_carried(c)))
                    return true;
    return false;
}

}  // namespace treeform
