#include <libmesh/io/corner_looks.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace treeform::detail::io {

namespace {

/// The row that all corners of each point have; empty where rows differ in value.
template <class Row>
[[nodiscard]] std::vector<std::uint32_t> rows_of_points(const mesh& m,
                                                        std::span<const face> rows_of_corner,
                                                        std::span<const Row> rows) {
    constexpr std::uint32_t none = corner_values::none;
    std::vector<std::uint32_t> row_of(m.points.size(), none);
    for (std::size_t f = 0; f < rows_of_corner.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t row = rows_of_corner[f][k];
            std::uint32_t& held = row_of[m.faces[f][k]];
            if (row == none) return {};
            if (held == none) held = row;
            if (held != row && rows[held] != rows[row]) return {};
        }
    return row_of;
}

template <class Row, class Value>
[[nodiscard]] column column_of(const char* name, std::span<const std::uint32_t> row_of,
                               std::span<const Row> rows, const Value& value) {
    std::vector<double> values(row_of.size(), 0.0);
    for (std::size_t v = 0; v < values.size(); ++v)
        if (row_of[v] != corner_values::none) values[v] = value(rows[row_of[v]]);
    return column::of<double>(name, values);
}

}  // namespace

std::vector<column> normals_of_points(const mesh_file& file) {
    const corner_values& corners = file.attributes.corners;
    const std::span<const point3> rows(corners.normals);
    const auto row_of = rows_of_points(file.mesh, corners.normal_of_corner, rows);
    if (corners.normal_of_corner.empty() || row_of.empty()) return {};
    return {column_of("nx", row_of, rows, [](const point3& n) { return n.x; }),
            column_of("ny", row_of, rows, [](const point3& n) { return n.y; }),
            column_of("nz", row_of, rows, [](const point3& n) { return n.z; })};
}

std::vector<column> texture_of_points(const mesh_file& file) {
    using row = std::array<double, 3>;
    const corner_values& corners = file.attributes.corners;
    const std::span<const row> rows(corners.texture);
    const auto row_of = rows_of_points(file.mesh, corners.texture_of_corner, rows);
    if (corners.texture_of_corner.empty() || row_of.empty()) return {};
    return {column_of("s", row_of, rows, [](const row& r) { return r[0]; }),
            column_of("t", row_of, rows, [](const row& r) { return r[1]; })};
}

}  // namespace treeform::detail::io
