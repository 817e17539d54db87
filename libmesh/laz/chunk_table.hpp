#pragma once
/// \file
/// Where the chunks of a LAZ file are, and how many points each has.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::laz {

struct chunk {
    std::uint32_t points = 0;
    std::uint32_t bytes = 0;
};

/// The chunks of a table that `packed` begins with: a version, the number of chunks, and their
/// compressed sizes. Where sizes vary, `points` of each are in the table; else they are 0 here.
///
/// `most` is how many chunks there can be: a table that says more is damaged.
///
/// \throws damaged
[[nodiscard]] std::vector<chunk> read_chunk_table(std::span<const std::uint8_t> packed,
                                                  bool sizes_vary, std::size_t most);

[[nodiscard]] std::vector<std::uint8_t> write_chunk_table(std::span<const chunk> chunks,
                                                          bool sizes_vary);

}  // namespace treeform::detail::laz
