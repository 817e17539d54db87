#pragma once
/// \file
/// The positions and numbers of points of the chunks of a LAZ file.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::laz {

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
