#pragma once
/// \file
/// The lines along which faces meet, as a file to be drawn.

#include "tools/shell/run.hpp"
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <span>
#include <vector>

namespace tools {

/// \throws failure (bad_usage) for a path that is neither "-", of an obj nor of a ply
void check_curve_path(const std::filesystem::path& path);

/// As `tf::write_curves`. Nothing where no `path` is named, and in a dry run. \throws failure
/// (bad_output)
void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs,
                  const std::vector<tf::pair_column>& numbers);

}  // namespace tools
