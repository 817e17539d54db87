#pragma once
/// \file
/// 4x4 matrices as text: row-major, column vectors, new = M * old.

#include "tools/shell/run.hpp"
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <filesystem>
#include <string>

namespace tools {

/// A 4x4 matrix in a file: 16 numbers by rows, the last row 0 0 0 1; or a report that has one
/// matrix. The identity without a path.
/// \throws failure (bad_input)
[[nodiscard]] tf::transform<3> read_matrix(const std::filesystem::path& path);

/// Four lines of four numbers with 17 digits.
[[nodiscard]] std::string matrix_text(const tf::transform<3>& matrix);

/// Writes that of one matrix or several to `path`, where one is named. \throws failure (bad_output)
void write_matrix(const job& work, const std::filesystem::path& path, const std::string& text);

}  // namespace tools
