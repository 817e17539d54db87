#include <treeform/mesh/attributes.hpp>

namespace treeform {
namespace {

std::vector<face> gather(const std::vector<face>& numbers,
                         std::span<const std::uint32_t> triangles) {
    std::vector<face> rows;
    if (numbers.empty()) return rows;
    rows.reserve(triangles.size());
    for (const std::uint32_t t : triangles) rows.push_back(numbers[t]);
    return rows;
}

/// Behind numbers of `before` triangles; the new ones are of rows that follow `rows` others.
void append(std::vector<face>& to, const std::vector<face>& more, std::size_t rows,
            std::size_t before, std::size_t after) {
    constexpr std::uint32_t none = corner_values::none;
    if (to.empty() && more.empty()) return;
    to.resize(before, {none, none, none});
    for (face numbers : more) {
        for (std::uint32_t& row : numbers)
            if (row != none) row += static_cast<std::uint32_t>(rows);
        to.push_back(numbers);
    }
    to.resize(after, {none, none, none});
}

std::string fault_of(const std::vector<face>& numbers, std::size_t rows, std::size_t triangles,
                     const std::string& what) {
    if (numbers.empty()) return {};
    if (numbers.size() != triangles)
        return what + " numbers of " + std::to_string(numbers.size()) + " triangles for " +
               std::to_string(triangles);
    for (std::size_t f = 0; f < numbers.size(); ++f)
        for (const std::uint32_t row : numbers[f])
            if (row >= rows && row != corner_values::none)
                return "a corner of triangle " + std::to_string(f) + " has a " + what +
                       " that is not there";
    return {};
}

}  // namespace

corner_values gather(const corner_values& c, std::span<const std::uint32_t> triangles) {
    return {.texture = c.texture,
            .has_w = c.has_w,
            .normals = c.normals,
            .texture_of_corner = gather(c.texture_of_corner, triangles),
            .normal_of_corner = gather(c.normal_of_corner, triangles)};
}

void append(corner_values& to, std::size_t triangles, const corner_values& more,
            std::size_t more_triangles) {
    const std::size_t after = triangles + more_triangles;
    append(to.texture_of_corner, more.texture_of_corner, to.texture.size(), triangles, after);
    append(to.normal_of_corner, more.normal_of_corner, to.normals.size(), triangles, after);
    to.texture.insert(to.texture.end(), more.texture.begin(), more.texture.end());
    to.normals.insert(to.normals.end(), more.normals.begin(), more.normals.end());
    to.has_w = to.has_w || more.has_w;
}

std::string fault_of(const corner_values& c, std::size_t triangles) {
    std::string fault =
        fault_of(c.texture_of_corner, c.texture.size(), triangles, "texture coordinate");
    if (fault.empty()) fault = fault_of(c.normal_of_corner, c.normals.size(), triangles, "normal");
    return fault;
}

}  // namespace treeform
