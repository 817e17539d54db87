#pragma once
/// \file
/// The columns of points in a file with types.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/attributes.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace treeform::detail::io {

/// The columns of the element "vertex" to be written: those of the file, without values, and those
/// of the coordinates. Missing coordinate columns are added before all others.
///
/// `points` are all points; none if they will be written in blocks. Declared types are kept where
/// possible: text may have more digits than the type, binary data may not.
[[nodiscard]] element declare_vertices(const write_job& job, bool text,
                                       std::optional<std::span<const point3>> points);

/// The coordinates whose column type cannot represent all of `points`.
[[nodiscard]] std::array<bool, 3> outgrown_axes(const element& declared,
                                                std::span<const point3> points);

/// Checks points written in blocks, whose types were chosen before the points were known.
///
/// \throws std::invalid_argument if a point does not fit
void check_axes(const write_job& job, bool text, const element& declared,
                std::span<const point3> points);

/// The column of values of the declared data column `i`.
[[nodiscard]] inline const column& with_values(const element& declared, const element* source,
                                               std::size_t i) {
    return source->columns[i - (declared.columns.size() - source->columns.size())];
}

/// Whether a text format writes a column with the digits of a double regardless of its type.
[[nodiscard]] inline bool keeps_digits(const column& c) {
    return c.role != column_role::data && c.type == scalar_type::float32;
}

}  // namespace treeform::detail::io
