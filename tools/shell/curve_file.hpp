#pragma once
/// \file
/// The lines along which faces meet, as a file to be drawn; matrices in files.

#include "tools/shell/run.hpp"
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// \throws failure (bad_usage) for a path that is neither "-", of an obj nor of a ply
void check_curve_path(const std::filesystem::path& path);

/// As `tf::write_curves`. Nothing where no `path` is named, and in a dry run. \throws failure
/// (bad_output)
void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs,
                  const std::vector<tf::pair_column>& numbers);

/// A 4x4 matrix in a file: 16 numbers by rows, the last row 0 0 0 1; or a report that has one
/// matrix. The identity without a path.
/// \throws failure (bad_input)
[[nodiscard]] tf::transform<3> read_matrix(const std::filesystem::path& path);

/// Four lines of four numbers with 17 digits.
[[nodiscard]] std::string matrix_text(const tf::transform<3>& matrix);

/// Writes that of one matrix or several to `path`, where one is named. \throws failure (bad_output)
void write_matrix(const job& work, const std::filesystem::path& path, const std::string& text);

}  // namespace tools
