#pragma once
/// \file
/// The LZF compression of PCD files: runs of literals, and copies of at most 264 bytes from at most
/// 8192 bytes back.
///
/// A byte below 32 is the number of literals that follow, minus one. Otherwise its upper three bits
/// are the length of a copy minus two (if seven, the next byte is added); its lower five bits and
/// the last byte are the distance minus one.
///
/// \source Lehmann, the stream format of LibLZF

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// Upper bound of unpacked bytes for each packed byte.
constexpr std::size_t lzf_most_ratio = 88;

/// Blocks of this many bytes are packed independently, so that several processes can pack blocks,
/// and the concatenated results equal that of one process.
constexpr std::size_t lzf_block = std::size_t{1} << 20;

/// Upper bound of the packed size: only literals are longer than their bytes, by one byte for every
/// 32, and the size of a block is a multiple of 32.
[[nodiscard]] constexpr std::size_t lzf_most_packed(std::size_t size) {
    return size + size / 32 + 1;
}

/// Called with the positions reached, every few megabytes.
using lzf_progress = std::function<void(std::size_t packed, std::size_t unpacked)>;

/// Unpacks to exactly `size` bytes; false if the packed bytes have another size.
[[nodiscard]] bool lzf_unpack(std::string_view packed, char* to, std::size_t size,
                              const lzf_progress& progress = {});

/// The state of unpacking a stream.
struct lzf_place {
    std::size_t packed = 0;
    std::size_t unpacked = 0;
    std::string last{};  ///< the last unpacked bytes, as many as a copy can reach
};

/// Continues to unpack from `place` until the number of bytes read and written reaches `end` (or
/// slightly more), or the packed bytes end. Calls `put` with a few megabytes at a time, to be
/// written at `place.unpacked`. Returns false if the stream is damaged, or has more than `size`
/// bytes. At the end, `place` must be at both ends.
[[nodiscard]] bool lzf_unpack_on(std::string_view packed, lzf_place& place, std::size_t end,
                                 std::size_t size,
                                 const std::function<void(std::string_view bytes)>& put);

/// Packs, and returns the packed size. \pre `to` has room for `lzf_most_packed` bytes
[[nodiscard]] std::size_t lzf_pack(std::string_view bytes, char* to,
                                   const lzf_progress& progress = {});

}  // namespace treeform::detail::io
