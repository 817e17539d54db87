#pragma once
/// \file
/// Rows behind the points of a file whose places only those know who have read what is ahead of
/// them.

#include <libmesh/io/point_blocks.hpp>
#include <libmesh/stream/communicator.hpp>

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace treeform::detail::stream {

/// As for `io::point_blocks`.
struct file_of_rows {
    const std::filesystem::path& path;
    std::string_view format{};
    io::row_use use = io::row_use::copied;
    const io::record_index* known = nullptr;
};

/// Each rank in turn reads on where the one before has ended, up to the end of its share of the
/// bytes, and calls `take` with each block that it reads, and then `done`. Returns where the rows
/// of each begin, and where the last ones end. Collective: every rank must call this; all throw
/// what is wrong first in the file.
///
/// \throws io_error, and what `take` throws
[[nodiscard]] std::vector<io::row_place> rows_in_turn(
    const communicator& all, const file_of_rows& of,
    const std::function<void(const io::row_block&)>& take,
    const std::function<void(const io::point_blocks&)>& done = {});

}  // namespace treeform::detail::stream
