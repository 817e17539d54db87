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
void append_numbers(std::vector<face>& to, const std::vector<face>& more, std::size_t rows,
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
                       " number that is out of range";
    return {};
}

}  // namespace

corner_values corner_values::gathered(std::span<const std::uint32_t> triangles) const {
    return {.texture = texture,
            .has_w = has_w,
            .normals = normals,
            .texture_of_corner = gather(texture_of_corner, triangles),
            .normal_of_corner = gather(normal_of_corner, triangles)};
}

void corner_values::append(std::size_t triangles, const corner_values& more,
                           std::size_t more_triangles) {
    const std::size_t after = triangles + more_triangles;
    append_numbers(texture_of_corner, more.texture_of_corner, texture.size(), triangles, after);
    append_numbers(normal_of_corner, more.normal_of_corner, normals.size(), triangles, after);
    texture.insert(texture.end(), more.texture.begin(), more.texture.end());
    normals.insert(normals.end(), more.normals.begin(), more.normals.end());
    has_w = has_w || more.has_w;
}

std::string corner_values::fault(std::size_t triangles) const {
    std::string found =
        fault_of(texture_of_corner, texture.size(), triangles, "texture coordinate");
    if (found.empty()) found = fault_of(normal_of_corner, normals.size(), triangles, "normal");
    return found;
}

}  // namespace treeform
