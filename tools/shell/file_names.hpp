#pragma once
/// \file
/// Which names are names of one file; the files of a folder.

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tools {

/// Files by what their names lead to: spellings, links, and files that do not exist yet. Devices,
/// pipes and folders are no files and never known. \cost a few looks at the disk for each name
class file_names {
  public:
    /// Whether the file was not known before.
    bool add(const std::filesystem::path& path);
    [[nodiscard]] bool holds(const std::filesystem::path& path) const;

  private:
    std::set<std::filesystem::path> names_;        ///< absolute, without links
    std::set<std::pair<dev_t, ino_t>> on_disk_{};  ///< a file may have several names
};

/// `paths` with each folder replaced by its files with one of `extensions`, in the order of their
/// names. Subfolders are not searched. A folder without such files is kept, and so is "-".
[[nodiscard]] std::vector<std::string> files_of(std::span<const std::string> paths,
                                                std::span<const std::string> extensions);

}  // namespace tools
