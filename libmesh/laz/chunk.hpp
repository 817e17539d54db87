#pragma once
/// \file
/// A chunk of a LAZ file: consecutive point records, compressed without regard to others.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::laz {

/// What a point record consists of. The values are those of the format.
enum class item_type : std::uint16_t {
    bytes = 0,
    point10 = 6,
    gps_time11 = 7,
    color12 = 8,
    wave_packet13 = 9,
    point14 = 10,
    color14 = 11,
    color_infrared14 = 12,
    wave_packet14 = 13,
    bytes14 = 14
};

struct item {
    item_type type = item_type::bytes;
    std::uint16_t size = 0;  ///< bytes
    std::uint16_t version = 2;
    friend bool operator==(const item&, const item&) = default;
};

/// The items of a record of the point data format `format` (0 to 10) and `size` bytes, in the
/// versions that are written here.
///
/// \pre `size` is at least that of the format
[[nodiscard]] std::vector<item> items_of(unsigned format, std::size_t size);

/// Whether chunks of these items have layers: those of formats 6 to 10.
[[nodiscard]] bool is_layered(std::span<const item> items);

/// Whether this program knows the items: their types, sizes and versions, in the order in which
/// they stand in records.
[[nodiscard]] bool is_known(std::span<const item> items);

[[nodiscard]] std::size_t record_size(std::span<const item> items);

/// Replaces `records` by the records in the chunk that `packed` begins with. `records` has room for
/// `count` of them, one or more.
///
/// \pre    `is_known(items)`
/// \throws damaged
void unpack_chunk(std::span<const item> items, std::span<const std::uint8_t> packed,
                  std::uint32_t count, std::uint8_t* records);

/// The bytes of a chunk of `count` records, one or more.
///
/// \pre `items` come from `items_of`
[[nodiscard]] std::vector<std::uint8_t> pack_chunk(std::span<const item> items, std::uint32_t count,
                                                   const std::uint8_t* records);

}  // namespace treeform::detail::laz
