#pragma once
/// \file
/// tf-repair --wrap: a closed surface around whatever there is.

#include "tools/shell/command_line.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-repair/outputs.hpp"

#include <filesystem>
#include <optional>

namespace tools {

/// --wrap and --offset.
void add_wrapping(command_line& line, wrap_settings& target);

/// Refuses what has no meaning with --wrap, and --offset without it. \throws failure (bad_usage)
void check_wrapping(const command_line& line, const wrap_settings& settings);

/// Wraps the mesh, enters it in the report, says so, and writes it where there is a path.
/// \throws failure
exit_status wrap(job& work, const dirty_mesh& input, const wrap_settings& settings,
                 const std::optional<std::filesystem::path>& output);

}  // namespace tools
