#pragma once
/// \file
/// Which columns the points get in a file that has types.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/attributes.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace treeform::detail::io {

/// The columns of the element "vertex" as they will be written: those of the file, without values,
/// and those of the coordinates; what is missing of these stands ahead of all others.
///
/// `points` are all points; none when they will come by runs. A declared type stays where it can:
/// text may have more digits than the type, bytes may not.
[[nodiscard]] element declare_vertices(const write_job& job, bool text,
                                       std::optional<std::span<const point3>> points);

/// Which coordinates have a column whose type does not hold all of `points`.
[[nodiscard]] std::array<bool, 3> outgrown_axes(const element& declared,
                                                std::span<const point3> points);

/// Of points that come by runs the types were chosen before they were known.
///
/// \throws std::invalid_argument when one does not fit
void check_axes(const write_job& job, bool text, const element& declared,
                std::span<const point3> points);

/// The column with the values that belongs to number `i` of the declared ones, which is data.
[[nodiscard]] inline const column& with_values(const element& declared, const element* source,
                                               std::size_t i) {
    return source->columns[i - (declared.columns.size() - source->columns.size())];
}

/// The column that a text format writes with the digits of a double whatever its type.
[[nodiscard]] inline bool keeps_digits(const column& c) {
    return c.role != column_role::data && c.type == scalar_type::float32;
}

}  // namespace treeform::detail::io
