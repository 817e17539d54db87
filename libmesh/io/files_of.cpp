#include <libmesh/io/extension.hpp>
#include <treeform/mesh/read.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace treeform {
namespace {

namespace fs = std::filesystem;

template <std::size_t N>
[[nodiscard]] bool is_among(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

[[nodiscard]] bool is_of(const fs::path& path, file_content content) {
    constexpr std::array<std::string_view, 7> meshes{"stl", "obj", "ply", "off",
                                                     "3mf", "glb", "gltf"};
    constexpr std::array<std::string_view, 7> points{"pcd", "las", "laz", "xyz",
                                                     "csv", "pts", "asc"};
    const std::string extension = detail::io::extension_of(path);
    return is_among(meshes, extension) ||
           (content == file_content::meshes_and_points && is_among(points, extension));
}

/// Ascending; none where the folder cannot be looked into, which reading it will say.
[[nodiscard]] std::vector<std::string> files_in(const fs::path& folder, file_content content) {
    std::vector<std::string> files;
    std::error_code error;
    fs::directory_iterator at(folder, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error))
        if (is_of(at->path(), content) && !at->is_directory(error))
            files.push_back(at->path().string());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

std::vector<std::string> files_of(std::span<const std::string> paths, file_content content) {
    std::vector<std::string> all;
    for (const std::string& path : paths) {
        std::error_code ignored;
        const bool folder = path != "-" && fs::is_directory(path, ignored);
        std::vector<std::string> files = folder ? files_in(path, content) : std::vector{path};
        if (files.empty()) files.push_back(path);
        all.insert(all.end(), files.begin(), files.end());
    }
    return all;
}

}  // namespace treeform
