#pragma once
/// \file
/// Meshes that have been checked in the coordinates to be written, and how they are written so.

#include "tools/common/carried_properties.hpp"
#include "tools/common/run.hpp"
#include <libmesh/io/mesh_file.hpp>
#include <libmesh/io/write.hpp>

#include <filesystem>
#include <optional>
#include <span>

namespace tools {

/// Whether coordinates become floats on the way to `output`: where its format has nothing else, or
/// where the user, or else every input, says so. Known before the work, which depends on it.
[[nodiscard]] bool writes_single(const common_options& options,
                                 const std::optional<std::filesystem::path>& output,
                                 std::span<const property_source> inputs);

/// Writes `file` to `path`, reads it again, and only then gives it its name. Enters nothing.
/// \throws failure (bad_output); std::logic_error when the file does not hold what was checked
tf::write_result write_certified(job& work, tf::mesh_file& file, const std::filesystem::path& path);

}  // namespace tools
