#include "tools/shell/folder_files.hpp"

#include "tools/shell/common_options.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Ascending; none where the folder cannot be looked into, which reading it will say.
[[nodiscard]] std::vector<std::string> files_in(const fs::path& folder,
                                                std::span<const std::string> extensions) {
    std::vector<std::string> files;
    std::error_code error;
    fs::directory_iterator at(folder, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error))
        if (std::ranges::count(extensions, extension_of(at->path())) > 0 &&
            !at->is_directory(error))
            files.push_back(at->path().string());
    std::ranges::sort(files);
    return files;
}

}  // namespace

std::vector<std::string> files_of(std::span<const std::string> paths,
                                  std::span<const std::string> extensions) {
    std::vector<std::string> all;
    for (const std::string& path : paths) {
        std::error_code ignored;
        const bool folder = path != "-" && fs::is_directory(path, ignored);
        std::vector<std::string> files = folder ? files_in(path, extensions) : std::vector{path};
        if (files.empty()) files.push_back(path);
        all.insert(all.end(), files.begin(), files.end());
    }
    return all;
}

}  // namespace tools
