#pragma once
/// \file
/// The common header of LAS files that are joined.

#include <treeform/mesh/mesh_file.hpp>

#include <optional>
#include <span>
#include <string>

namespace treeform::detail::carry {

/// The header of the first file, if it is LAS; otherwise empty. Scale and offset are changed so
/// that they can represent the points of all files, as far as the bounds in the headers tell. It
/// describes the extra bytes of all files.
///
/// \throws std::invalid_argument for files with different coordinate systems or types of GPS time,
///         unless `mixed`
[[nodiscard]] std::optional<las_header> join_las(std::span<const mesh_file> files,
                                                 std::span<const std::string> names, bool mixed);

}  // namespace treeform::detail::carry
