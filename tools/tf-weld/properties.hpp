#pragma once
/// \file
/// Names of properties, as users say them, and the columns of a file.

#include "tools/tf-weld/settings.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <vector>

namespace tools {

/// What `--same` and `--across` mean for `file`, in terms of its columns of "vertex" and x, y, z.
///
/// A name is that of a column, or else a group: normal, uv, colour, color. The seams of a mesh (the
/// groups) must agree unless named by `--across`; those of a cloud need not. A group that the file
/// does not have may be let go all the same.
///
/// \throws failure (bad_input) for a name that the file does not have, or whose values are lists
[[nodiscard]] std::vector<tf::weld_condition> conditions_of(const tf::mesh_file& file,
                                                            const weld_settings& settings);

/// \throws failure (bad_input) when `--keep` names no property of `file` with one value a point
void check_keep(const tf::mesh_file& file, const weld_settings& settings);

}  // namespace tools
