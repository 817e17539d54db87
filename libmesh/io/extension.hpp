#pragma once
/// \file
/// Normalizes file extensions for comparison.

#include <libmesh/io/number.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// In lower case and without its dot.
[[nodiscard]] inline std::string plain_extension(std::string_view extension) {
    if (extension.starts_with('.')) extension.remove_prefix(1);
    std::string plain(extension);
    std::transform(plain.begin(), plain.end(), plain.begin(), to_lower);
    return plain;
}

[[nodiscard]] inline std::string extension_of(const std::filesystem::path& path) {
    return plain_extension(path.extension().string());
}

}  // namespace treeform::detail::io
