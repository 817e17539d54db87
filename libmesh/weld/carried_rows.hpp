#pragma once
/// \file
/// Attributes after points were merged and faces dropped.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/weld.hpp>

namespace treeform::detail::weld {

/// \throws std::invalid_argument for rows of "vertex" that are not one a point, rows of "face" that
///         are not one a face, columns that do not fit their rows, and corners likewise
void check_rows(const attributes& properties, std::size_t point_count, std::size_t face_count);

/// What `weld` returns of `properties`, given the other parts of its result but means.
[[nodiscard]] attributes carry_rows(const attributes& properties, const weld_result& welded);

}  // namespace treeform::detail::weld
