#pragma once
/// \file
/// The header of LAS files that become one.

#include <treeform/mesh/mesh_file.hpp>

#include <optional>
#include <span>
#include <string>

namespace treeform::detail::carry {

/// That of the first file, if it is LAS: with a scale and an offset that hold the points of all, as
/// far as their headers say where these are, and with what any of them says of extra bytes.
///
/// \throws std::invalid_argument for files of different reference systems or ways to count GPS
///         time, unless `mixed`
[[nodiscard]] std::optional<las_header> join_las(std::span<const mesh_file> files,
                                                 std::span<const std::string> names, bool mixed);

}  // namespace treeform::detail::carry
