#pragma once
/// \file
/// Meshes that have been checked in the coordinates to be written, and how they are written so.

#include "tools/common/run.hpp"
#include "tools/common/written_form.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <filesystem>

namespace tools {

/// Says so where rounding and mending have moved points by more than a step of the numbers written,
/// which rounding alone does not.
void warn_of_moves(job& work, tf::points_view points, double max_move, bool to_single);

/// Writes `file` to `path`, reads it again, and only then gives it its name. Enters nothing.
/// \throws failure (bad_output); std::logic_error when the file does not hold what was checked
tf::write_result write_certified(job& work, tf::mesh_file& file, const written_form& form,
                                 const std::filesystem::path& path);

}  // namespace tools
