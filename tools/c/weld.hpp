#pragma once
/// \file
/// Options that welding in memory and from file to file have in common.

#include <treeform/mesh/weld_options.hpp>

#include <tools/c/glue.hpp>

namespace glue {

[[nodiscard]] std::vector<tf::weld_condition> conditions(const treeform_weld_condition* same,
                                                         std::size_t count);

}  // namespace glue
