#include "tools/common/carried_properties.hpp"

#include <libmesh/attributes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

namespace tools {
namespace {

using weights = std::array<double, 3>;

bool is_normal(const std::string& name) { return name == "nx" || name == "ny" || name == "nz"; }

bool can_be_carried(const tf::element& e, const tf::column& c) {
    return c.role == tf::column_role::data && !c.list_length &&
           !(e.name == "vertex" && is_normal(c.name));
}

/// A property by its name, and where each input has it.
struct property {
    std::string name;
    tf::scalar_type type;
    std::vector<const tf::column*> of_input;  ///< null where it has none
};

std::vector<property> properties_of(std::span<const property_source> inputs, const char* element) {
    std::vector<property> all;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        const tf::element* e = tf::find_element(inputs[k].file->attributes, element);
        if (e == nullptr) continue;
        for (const tf::column& c : e->columns) {
            if (!can_be_carried(*e, c)) continue;
            auto at = std::find_if(all.begin(), all.end(),
                                   [&](const property& p) { return p.name == c.name; });
            if (at == all.end()) {
                all.push_back({c.name, c.type, {}});
                all.back().of_input.resize(inputs.size(), nullptr);
                at = all.end() - 1;
            }
            if (at->type != c.type) at->type = tf::scalar_type::float64;
            at->of_input[k] = &c;
        }
    }
    return all;
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
tf::column make_values(const property& p, std::size_t rows, ValueOf value_of) {
    return tf::with_type(p.type, [&](auto zero) {
        using T = decltype(zero);
        std::vector<T> values(rows);
        for (std::size_t row = 0; row < rows; ++row) values[row] = nearest<T>(value_of(row));
        return tf::make_column<T>(p.name, values);
    });
}

tf::point3 difference(const tf::point3& p, const tf::point3& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
}

tf::point3 cross(const tf::point3& u, const tf::point3& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

double dot(const tf::point3& u, const tf::point3& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

/// How much of each corner of a triangle there is in a point of it; sums up to 1.
weights weights_of(const tf::point3& p, const tf::point3& a, const tf::point3& b,
                   const tf::point3& c) {
    const tf::point3 normal = cross(difference(b, a), difference(c, a));
    const tf::point3 to_a = difference(a, p), to_b = difference(b, p), to_c = difference(c, p);
    weights w{dot(normal, cross(to_b, to_c)), dot(normal, cross(to_c, to_a)),
              dot(normal, cross(to_a, to_b))};
    double sum = 0.0;
    for (double& one : w) sum += one = std::max(one, 0.0);
    if (!(sum > 0.0) || !std::isfinite(sum)) return {1.0, 0.0, 0.0};
    for (double& one : w) one /= sum;
    return w;
}

/// The input points that a point of the result has its values from.
struct mixture {
    std::uint32_t input = 0;
    tf::face points{};
    weights shares{1.0, 0.0, 0.0};
};

std::vector<mixture> mixtures_of(std::span<const property_source> inputs, const tf::mesh& surface,
                                 std::span<const tf::operand_element> source_face,
                                 std::span<const tf::operand_element> source_point) {
    std::vector<mixture> all(surface.points.size());
    std::vector<std::uint8_t> known(all.size(), 0);
    for (std::size_t p = 0; p < all.size(); ++p) {
        const tf::operand_element source = source_point[p];
        if (source == tf::operand_element{}) continue;
        all[p] = {source.operand, {source.index, source.index, source.index}};
        known[p] = 1;
    }
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        for (const std::uint32_t p : surface.faces[f]) {
            if (known[p] != 0) continue;
            const auto [operand, index] = source_face[f];
            if (operand == tf::operand_element::none) continue;
            const tf::mesh& mesh = inputs[operand].file->mesh;
            const tf::face& corners = mesh.faces[index];
            all[p] = {operand, corners,
                      weights_of(surface.points[p], mesh.points[corners[0]],
                                 mesh.points[corners[1]], mesh.points[corners[2]])};
            known[p] = 1;
        }
    return all;
}

double value_of(const property& p, const mixture& m) {
    const tf::column* values = p.of_input[m.input];
    if (values == nullptr) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        if (m.shares[k] > 0.0) sum += m.shares[k] * tf::number_at(*values, m.points[k]);
    return sum;
}

}  // namespace

void carry_properties(tf::mesh_file& file, std::span<const property_source> inputs,
                      std::span<const tf::operand_element> source_face,
                      std::span<const tf::operand_element> source_point) {
    const tf::mesh& surface = file.mesh;
    if (const auto of_points = properties_of(inputs, "vertex"); !of_points.empty()) {
        const std::vector<mixture> mixtures =
            mixtures_of(inputs, surface, source_face, source_point);
        tf::element& rows = tf::obtain_element(file.attributes, "vertex", surface.points.size());
        for (const property& p : of_points)
            rows.columns.push_back(make_values(
                p, mixtures.size(), [&](std::size_t row) { return value_of(p, mixtures[row]); }));
    }
    if (const auto of_faces = properties_of(inputs, "face"); !of_faces.empty()) {
        tf::element& rows = tf::obtain_element(file.attributes, "face", surface.faces.size());
        for (const property& p : of_faces)
            rows.columns.push_back(make_values(p, surface.faces.size(), [&](std::size_t row) {
                const auto [operand, index] = source_face[row];
                const tf::column* values =
                    operand == tf::operand_element::none ? nullptr : p.of_input[operand];
                return values == nullptr
                           ? std::numeric_limits<double>::quiet_NaN()
                           : tf::number_at(*values, inputs[operand].stored_face(index));
            }));
    }
}

bool leaves_out_properties(std::span<const property_source> inputs) {
    for (const property_source& input : inputs)
        for (const tf::element& e : input.file->attributes.elements)
            for (const tf::column& c : e.columns)
                if (c.role == tf::column_role::data &&
                    ((e.name != "vertex" && e.name != "face") || !can_be_carried(e, c)))
                    return true;
    return false;
}

}  // namespace tools
