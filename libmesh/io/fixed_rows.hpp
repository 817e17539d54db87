#pragma once
/// \file
/// Binary rows of fixed size: PLY without lists, PCD.

#include <libmesh/io/file_part.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::io {

/// The position of a column's value in the first row, and the distance to that in the next row.
struct value_place {
    const char* first = nullptr;
    std::size_t stride = 0;
};

/// Appends `rows` points and their rows to `points` and to the columns of `vertices`; `places` has
/// one entry for each column. Works column by column on blocks of rows that fit into the L1 cache,
/// so that each loop has a single type.
void append_fixed_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                       std::span<const value_place> places, std::endian order);

/// Size of a row in bytes; zero if there is a list.
[[nodiscard]] std::size_t fixed_row_size(const element& e);

/// Rows of equal size.
struct alike_rows {
    std::uint64_t count = 0;
    std::uint64_t size = 0;
};

/// Divides rows, of which the first is at byte `begin`, into `count` parts of about equal size in
/// bytes. Returns the begin of each part and the end of the last.
[[nodiscard]] std::vector<row_place> parts_of_rows(std::uint64_t begin,
                                                   std::span<const alike_rows> rows,
                                                   std::size_t count);

}  // namespace treeform::detail::io
