#include "tools/shell/file_names.hpp"

#include "tools/shell/common_options.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Nothing exists at most outputs' paths; the folders ahead of them do.
fs::path whole_name(const fs::path& path) {
    std::error_code error;
    fs::path whole = fs::absolute(path, error);
    if (error) whole = path;
    fs::path name = fs::weakly_canonical(whole, error);
    return error ? whole.lexically_normal() : name;
}

struct file_identity {
    fs::path name;
    std::optional<std::pair<dev_t, ino_t>> on_disk;
};

std::optional<file_identity> identity_of(const fs::path& path) {
    struct stat there {};
    if (stat(path.c_str(), &there) != 0) return file_identity{whole_name(path), std::nullopt};
    if (!S_ISREG(there.st_mode)) return std::nullopt;
    return file_identity{whole_name(path), std::pair{there.st_dev, there.st_ino}};
}

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

bool file_names::add(const fs::path& path) {
    auto file = identity_of(path);
    if (!file) return true;
    const bool new_name = names_.insert(std::move(file->name)).second;
    const bool new_on_disk = !file->on_disk || on_disk_.insert(*file->on_disk).second;
    return new_name && new_on_disk;
}

bool file_names::holds(const fs::path& path) const {
    const auto file = identity_of(path);
    return file &&
           (names_.contains(file->name) || (file->on_disk && on_disk_.contains(*file->on_disk)));
}

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
