#pragma once
/// \file
/// Resolves the names of vertex properties in options to columns.

#include <treeform/mesh/weld_options.hpp>

#include <string>

namespace treeform::detail::weld {

/// The columns that `options.keep_by` and `options.order_by` name.
/// \throws weld_property_error when the name matches no column, several columns, or a list column
[[nodiscard]] std::string column_to_keep_by(const attributes& properties,
                                            const weld_options& options);
[[nodiscard]] std::string column_to_order_by(const attributes& properties,
                                             const weld_options& options);

}  // namespace treeform::detail::weld
