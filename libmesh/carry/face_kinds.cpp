#include <libmesh/carry/face_kinds.hpp>
#include <libmesh/carry/materials.hpp>

#include <cmath>
#include <limits>

namespace treeform::detail::carry {
namespace {

/// None, one value, or the number of the face.
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

}  // namespace

face_kinds::face_kinds(std::span<const carry_source> inputs, bool by_corners) : inputs_(inputs) {
    for (const carry_source& input : inputs) {
        const attributes& all = input.file->attributes;
        has_corner_values_ =
            has_corner_values_ || (by_corners && (!all.corners.texture_of_corner.empty() ||
                                                  !all.corners.normal_of_corner.empty()));
        for (const part& p : all.parts)
            if (!p.material.empty())
                materials_.try_emplace(p.material, static_cast<double>(materials_.size() + 1));
    }
}

void face_kinds::append(std::uint32_t input, std::uint32_t face,
                        std::vector<double>& values) const {
    if (empty()) return;
    const carry_source& source = inputs_[input];
    const auto material = materials_.find(material_of(source, face));
    values.push_back(material == materials_.end() ? 0.0 : material->second);
    if (!has_corner_values_) return;
    const corner_values& corners = source.file->attributes.corners;
    const std::uint32_t triangle = source.triangle(face);
    append_kind(corners.texture, corners.texture_of_corner, input, triangle, values);
    append_kind(corners.normals, corners.normal_of_corner, input, triangle, values);
}

}  // namespace treeform::detail::carry
