#pragma once
/// \file
/// Rows of bytes in which each value has its place: binary PLY without lists, binary PCD.

#include <libmesh/io/file_part.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::io {

/// Where the value of a column stands in the first row, and how far it is to the next row's.
struct value_place {
    const char* first = nullptr;
    std::size_t stride = 0;
};

/// Appends `rows` points and their rows to `points` and to the columns of `vertices`; `places` has
/// one entry a column. A column at a time, a few rows at a time: loops of one type each, on what
/// the first cache holds.
void append_fixed_rows(element& vertices, std::vector<point3>& points, std::size_t rows,
                       std::span<const value_place> places, std::endian order);

/// Bytes of a row; zero when a list has none of its own.
[[nodiscard]] std::size_t fixed_row_size(const element& e);

/// Rows of one size.
struct alike_rows {
    std::uint64_t count = 0;
    std::uint64_t size = 0;
};

/// Where `count` parts of rows begin that have about as many bytes each, and where the last one
/// ends; the first row is at byte `begin`.
[[nodiscard]] std::vector<row_place> parts_of_rows(std::uint64_t begin,
                                                   std::span<const alike_rows> rows,
                                                   std::size_t count);

}  // namespace treeform::detail::io
