#pragma once
/// \file
/// SHA-256, to name an input beyond doubt in a report.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace tools {

/// \source FIPS 180-4, Secure Hash Standard, sections 4.1.2, 4.2.2, 5 and 6.2
class sha256 {
  public:
    void add(std::span<const std::byte> bytes);
    /// The digest of all bytes added, as 64 hexadecimal digits; the object is spent.
    [[nodiscard]] std::string hex();

  private:
    void add_block(const std::byte* block);

    std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<std::byte, 64> pending_{};
    std::size_t pending_size_ = 0;
    std::uint64_t total_ = 0;
};

/// Digest of the file at `path`; empty when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace tools
