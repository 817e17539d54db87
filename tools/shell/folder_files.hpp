#pragma once
/// \file
/// The files of folders that are inputs.

#include <span>
#include <string>
#include <vector>

namespace tools {

/// `paths` with each folder replaced by its files with one of `extensions`, in the order of their
/// names. Subfolders are not searched. A folder without such files is kept, and so is "-".
[[nodiscard]] std::vector<std::string> files_of(std::span<const std::string> paths,
                                                std::span<const std::string> extensions);

}  // namespace tools
