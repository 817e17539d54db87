#pragma once
/// \file
/// A chunk of a LAZ file: consecutive point records, compressed without regard to others. Where the
/// chunks are, and how many points each has.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::laz {

/// The types of items in a point record. The values are those of the file format.
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

/// The items of a record with `size` bytes in point data format `format` (0 to 10), in the versions
/// that this library writes.
///
/// \pre `size` is at least the size of the format
[[nodiscard]] std::vector<item> items_of(unsigned format, std::size_t size);

/// Whether chunks of these items have layers, as in formats 6 to 10.
[[nodiscard]] bool is_layered(std::span<const item> items);

/// Whether this library supports the items: their types, sizes and versions, in their order in
/// records.
[[nodiscard]] bool is_supported(std::span<const item> items);

[[nodiscard]] std::size_t record_size(std::span<const item> items);

/// Unpacks `count` >= 1 records of the chunk at the beginning of `packed` into `records`, which has
/// room for them.
///
/// \pre    `is_supported(items)`
/// \throws damaged
void unpack_chunk(std::span<const item> items, std::span<const std::uint8_t> packed,
                  std::uint32_t count, std::uint8_t* records);

/// The bytes of a chunk of `count` >= 1 records.
///
/// \pre `items` were returned by `items_of`
[[nodiscard]] std::vector<std::uint8_t> pack_chunk(std::span<const item> items, std::uint32_t count,
                                                   const std::uint8_t* records);

struct chunk {
    std::uint32_t points = 0;
    std::uint32_t bytes = 0;
};

/// Reads the chunk table at the beginning of `packed`: a version, the number of chunks, and their
/// compressed sizes. With `sizes_vary`, the table also has the number of points of each chunk;
/// otherwise `points` is 0.
///
/// `most` is the maximum number of chunks; a table with more is damaged.
///
/// \throws damaged
[[nodiscard]] std::vector<chunk> read_chunk_table(std::span<const std::uint8_t> packed,
                                                  bool sizes_vary, std::size_t most);

[[nodiscard]] std::vector<std::uint8_t> write_chunk_table(std::span<const chunk> chunks,
                                                          bool sizes_vary);

}  // namespace treeform::detail::laz
