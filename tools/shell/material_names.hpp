#pragma once
/// \file
/// Names of material and texture files, seen from another folder.

#include <filesystem>
#include <string>
#include <vector>

namespace tools {

/// `names`, which `input` gives relative to its folder, relative to that of `output`. As given
/// where both have one folder, where a name is absolute, or where one of them is a standard stream,
/// "-".
[[nodiscard]] std::vector<std::string> seen_from_output(std::vector<std::string> names,
                                                        const std::filesystem::path& input,
                                                        const std::filesystem::path& output);

}  // namespace tools
