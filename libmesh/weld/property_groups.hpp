#pragma once
/// \file
/// Names of vertex properties, as people say them, and the columns that they stand for.

#include <treeform/mesh/weld_options.hpp>

#include <string>

namespace treeform::detail::weld {

/// The columns that `options.keep_by` and `options.order_by` stand for.
/// \throws weld_property_error when it stands for none, for several, or for one of lists
[[nodiscard]] std::string column_to_keep_by(const attributes& properties,
                                            const weld_options& options);
[[nodiscard]] std::string column_to_order_by(const attributes& properties,
                                             const weld_options& options);

}  // namespace treeform::detail::weld
