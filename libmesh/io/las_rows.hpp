#pragma once
/// \file
/// Converts LAS point records to columns.

#include <libmesh/io/las_dimensions.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::io {

/// The conversion of stored integers to coordinates.
struct las_grid {
    std::array<double, 3> scale{};
    std::array<double, 3> offset{};

    /// The product is rounded, then the sum; compiled without floating-point contraction.
    [[nodiscard]] double coordinate(std::size_t axis, std::int32_t x) const {
        const double product = static_cast<double>(x) * scale[axis];
        return product + offset[axis];
    }
};

/// The columns of the element "vertex": the axes, then the dimensions.
[[nodiscard]] element las_columns(std::span<const las_dimension> dimensions);

/// Appends `rows` consecutive records from `first` on, in parallel.
void append_las_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                     const char* first, std::size_t record_size, const las_grid& grid,
                     std::span<const las_dimension> dimensions);

}  // namespace treeform::detail::io
