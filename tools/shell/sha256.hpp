#pragma once
/// \file
/// SHA-256, to name an input beyond doubt in a report.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace tools {

/// Of bytes that come one after the other, also to one process after the other.
class sha256 {
  public:
    sha256();
    /// Goes on from what another one has come to.
    explicit sha256(std::string_view state) : state_(state) {}

    void add(std::span<const std::byte> bytes);
    static constexpr std::uint64_t to_the_end = std::numeric_limits<std::uint64_t>::max();
    /// Returns whether all of these bytes of a file could be read.
    [[nodiscard]] bool add_from(const std::filesystem::path& path, std::uint64_t first,
                                std::uint64_t count);
    /// Of the same length always.
    [[nodiscard]] const std::string& state() const { return state_; }
    /// 64 hexadecimal digits.
    [[nodiscard]] std::string hex() const;

  private:
    std::string state_{};
};

/// The digest of `bytes` as 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of(std::span<const std::byte> bytes);

/// Digest of the file at `path`; empty when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace tools
