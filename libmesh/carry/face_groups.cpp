#include <libmesh/base/union_find.hpp>
#include <libmesh/carry/carried.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/attribute_sources.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

namespace treeform {
namespace detail::carry {
namespace {

/// Appends what is equal for faces that look alike: none, one value, or the number of the face, as
/// one whose corners differ is like no other.
template <class Row>
void append_kind(const std::vector<Row>& rows, const std::vector<face>& of_corner,
                 std::uint32_t input, std::uint32_t triangle, std::vector<double>& values) {
    constexpr std::uint32_t none = corner_values::none;
    const face numbers = of_corner.empty() ? face{none, none, none} : of_corner[triangle];
    const bool one = numbers[0] == numbers[1] && numbers[1] == numbers[2];
    if (one && numbers[0] == none) {
        values.insert(values.end(), {0.0, 0.0, 0.0, 0.0});
    } else if (!one) {
        values.insert(values.end(),
                      {1.0, static_cast<double>(input), static_cast<double>(triangle), 0.0});
    } else {
        values.push_back(2.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = rows[numbers[0]][i];
            values.push_back(std::isnan(x) ? -std::numeric_limits<double>::infinity() : x);
        }
    }
}

/// Rows of numbers, all of one length, each once.
class distinct_rows {
  public:
    distinct_rows() = default;
    distinct_rows(const distinct_rows&) = delete;
    distinct_rows& operator=(const distinct_rows&) = delete;

    /// As they came, from 0. \pre no number is NaN
    std::uint32_t number_of(std::span<const double> row) {
        length_ = row.size();
        values_.insert(values_.end(), row.begin(), row.end());
        const auto [at, is_new] = numbers_.insert(static_cast<std::uint32_t>(numbers_.size()));
        if (!is_new) values_.resize(values_.size() - length_);
        return *at;
    }

  private:
    [[nodiscard]] std::span<const double> row(std::uint32_t number) const {
        return std::span(values_).subspan(number * length_, length_);
    }
    struct hash {
        const distinct_rows* of;
        std::size_t operator()(std::uint32_t number) const {
            std::size_t all = 0;
            for (const double x : of->row(number))
                all = (all ^ std::hash<double>()(x)) * 0x9E3779B97F4A7C15U;
            return all ^ (all >> 32U);
        }
    };
    struct equal {
        const distinct_rows* of;
        bool operator()(std::uint32_t a, std::uint32_t b) const {
            return std::ranges::equal(of->row(a), of->row(b));
        }
    };

    std::size_t length_ = 0;
    std::vector<double> values_{};
    std::unordered_set<std::uint32_t, hash, equal> numbers_{0, hash{this}, equal{this}};
};

/// The criteria for faces of a group.
struct common_of_group {
    bool values = true;   ///< as for `attribute_sources::face_groups`
    bool input = false;   ///< as for `attribute_sources::face_groups`
    bool corners = true;  ///< with `values`, also corner values
};

/// As `attribute_sources::face_groups`.
std::vector<std::uint32_t> groups_of_faces(std::span<const attribute_source> inputs,
                                           const common_of_group& by) {
    std::vector<property> properties;
    std::map<std::string, double> materials;  // numbers from 1
    bool has_corner_values = false;
    if (by.values) properties = properties_of(inputs, "face");
    for (const attribute_source& input : inputs.first(by.values ? inputs.size() : 0)) {
        const attributes& all = input.file->attributes;
        has_corner_values =
            has_corner_values || (by.corners && (!all.corners.texture_of_corner.empty() ||
                                                 !all.corners.normal_of_corner.empty()));
        for (const named_faces& p : all.parts)
            if (!p.material.empty())
                materials.try_emplace(p.material, static_cast<double>(materials.size() + 1));
    }
    if (properties.empty() && materials.empty() && !has_corner_values && !by.input) return {};
    constexpr double nothing = -std::numeric_limits<double>::infinity();
    distinct_rows rows;
    std::vector<std::uint32_t> groups;
    std::vector<double> values;
    for (std::uint32_t k = 0; k < inputs.size(); ++k)
        for (std::uint32_t f = 0; f < inputs[k].file->mesh.faces.size(); ++f) {
            values.assign(1, by.input ? static_cast<double>(k) : 0.0);
            for (const property& p : properties) {
                const column* column = p.of_input[k];
                const double value = column ? column->number(inputs[k].face_in_file(f)) : nothing;
                values.push_back(std::isnan(value) ? nothing : value);
            }
            if (!materials.empty()) {
                const auto material = materials.find(material_of(inputs[k], f));
                values.push_back(material == materials.end() ? 0.0 : material->second);
            }
            if (has_corner_values) {
                const corner_values& corners = inputs[k].file->attributes.corners;
                const std::uint32_t triangle = inputs[k].triangle(f);
                append_kind(corners.texture, corners.texture_of_corner, k, triangle, values);
                append_kind(corners.normals, corners.normal_of_corner, k, triangle, values);
            }
            groups.push_back(rows.number_of(values));
        }
    return groups;
}

}  // namespace
}  // namespace detail::carry

std::vector<std::uint32_t> attribute_sources::face_groups(bool by_values, bool by_input) const {
    return detail::carry::groups_of_faces(all_, {.values = by_values, .input = by_input});
}

std::vector<std::uint32_t> attribute_sources::corner_groups() const {
    const attribute_source& input = all_.front();
    const mesh& mesh = input.file->mesh;
    const corner_values& values = input.file->attributes.corners;
    const auto groups = detail::carry::groups_of_faces(all_, {.corners = false});
    if (groups.empty() && values.texture_of_corner.empty() && values.normal_of_corner.empty())
        return {};
    const std::vector<std::uint32_t> first = detail::weld::equal_firsts(mesh.points, {});
    std::vector<face> faces = mesh.faces;
    for (face& f : faces)
        for (std::uint32_t& c : f) c = first[c];
    const auto corner_at = [&](std::uint32_t f, std::uint32_t p) {
        return static_cast<std::size_t>(std::ranges::find(faces[f], p) - faces[f].begin());
    };
    detail::base::union_find sets(3 * faces.size());
    const detail::weld::edge_uses edges(first.size(), faces,
                                        detail::weld::repeated_corners::left_out);
    edges.for_each([&](const detail::weld::used_edge& edge, std::size_t) {
        if (edge.uses.size() != 2) return;
        const std::uint32_t f = edge.face(0), g = edge.face(1);
        if (!groups.empty() && groups[f] != groups[g]) return;
        const std::array<std::array<std::size_t, 2>, 2> ends{
            {{corner_at(f, edge.low), corner_at(g, edge.low)},
             {corner_at(f, edge.high), corner_at(g, edge.high)}}};
        if (!detail::carry::look_alike(values, {input.triangle(f), input.triangle(g)}, ends))
            return;
        for (const auto& [i, j] : ends)
            sets.join(static_cast<std::uint32_t>(3 * f + i), static_cast<std::uint32_t>(3 * g + j));
    });
    const auto roots = sets.take_roots();
    return {roots.data(), roots.data() + roots.size()};
}

}  // namespace treeform
