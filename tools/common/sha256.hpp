#pragma once
/// \file
/// SHA-256, to name an input beyond doubt in a report.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace tools {

/// The digest of `bytes` as 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::span<const std::byte> bytes);

/// Digest of the file at `path`; empty when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace tools
