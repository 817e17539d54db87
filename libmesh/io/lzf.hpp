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
#include <string>
#include <string_view>

namespace treeform::detail::io {

/// No packed byte stands for more bytes than that.
constexpr std::size_t lzf_most_ratio = 88;

/// Each block of so many bytes is packed as if it were alone, so many can pack some blocks each,
/// and what they get, put one after the other, is what one gets.
constexpr std::size_t lzf_block = std::size_t{1} << 20;

/// Packed bytes are never more than that: only literals take more room than they stand for, a byte
/// for 32, and a whole block has a multiple of these.
[[nodiscard]] constexpr std::size_t lzf_most_packed(std::size_t size) {
    return size + size / 32 + 1;
}

/// Called with how far the unpacked bytes have come, every few megabytes.
using lzf_progress = std::function<void(std::size_t packed, std::size_t unpacked)>;

/// Unpacks to exactly `size` bytes; false when the packed bytes are not those of as many.
[[nodiscard]] bool lzf_unpack(std::string_view packed, char* to, std::size_t size,
                              const lzf_progress& progress = {});

/// How far a stream has been unpacked.
struct lzf_place {
    std::size_t packed = 0;
    std::size_t unpacked = 0;
    std::string last{};  ///< of the unpacked bytes, as many as a copy can reach
};

/// Unpacks on from a place until `end` bytes have been read and made in all, or a few more, or the
/// packed ones end. Calls `put` with some megabytes at a time, which belong at `place.unpacked` and
/// end at `place.packed`. False when the stream is damaged, or has more than `size` bytes. When all
/// is done, the place must be at both ends.
[[nodiscard]] bool lzf_unpack_on(std::string_view packed, lzf_place& place, std::size_t end,
                                 std::size_t size,
                                 const std::function<void(std::string_view bytes)>& put);

/// Packs and returns how many bytes it became. \pre there is room for `lzf_most_packed`
[[nodiscard]] std::size_t lzf_pack(std::string_view bytes, char* to,
                                   const lzf_progress& progress = {});

}  // namespace treeform::detail::io
