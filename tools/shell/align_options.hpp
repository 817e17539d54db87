#pragma once
/// \file
/// The options of an alignment, and what a report says of one.

#include "tools/shell/command_line.hpp"
#include "tools/shell/entries.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/tf.hpp>

#include <span>
#include <string>

namespace tools {

/// All but the largest distance, which may be a share of the diagonal.
void add_align_options(command_line& line, tf::align_options& options);
/// Their names.
[[nodiscard]] std::span<const char* const> align_option_names();

[[nodiscard]] json align_entry(const tf::align_result& result);

}  // namespace tools
