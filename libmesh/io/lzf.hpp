#pragma once
/// \file
/// The packing of PCD files: literal runs, and copies of at most 264 bytes from at most 8192 back.
///
/// A byte below 32 says how many literals follow, less one. Else its upper three bits are the
/// length of a copy, less two (seven: the next byte is added), its lower five and a last byte how
/// far back, less one.
///
/// \source Lehmann, the stream format of LibLZF

#include <cstddef>
#include <functional>
#include <string_view>

namespace treeform::detail::io {

/// No packed byte stands for more bytes than that.
constexpr std::size_t lzf_most_ratio = 88;

/// Packed bytes are never more than that.
[[nodiscard]] constexpr std::size_t lzf_most_packed(std::size_t size) {
    return size + size / 32 + 1;
}

/// Called with how far the unpacked bytes have come, every few megabytes.
using lzf_progress = std::function<void(std::size_t packed, std::size_t unpacked)>;

/// Unpacks to exactly `size` bytes; false when the packed bytes are not those of as many.
[[nodiscard]] bool lzf_unpack(std::string_view packed, char* to, std::size_t size,
                              const lzf_progress& progress = {});

/// Packs and returns how many bytes it became. \pre there is room for `lzf_most_packed`
[[nodiscard]] std::size_t lzf_pack(std::string_view bytes, char* to,
                                   const lzf_progress& progress = {});

}  // namespace treeform::detail::io
