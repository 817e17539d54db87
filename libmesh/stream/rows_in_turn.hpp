#pragma once
/// \file
/// Reads rows after the points of a file whose positions depend on all rows before them.

#include <libmesh/io/point_blocks.hpp>
#include <libmesh/stream/communicator.hpp>

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

namespace treeform::detail::stream {

/// A file, as for `io::point_blocks`.
struct file_of_rows {
    const std::filesystem::path& path;
    std::string_view format{};
    io::row_use use = io::row_use::copied;
    const io::record_index* known = nullptr;
};

/// Each rank in turn continues where the previous one ended, up to the end of its share of the
/// bytes, calls `take` with each block, and then `done`. Returns the position at which the rows of
/// each rank begin, and the end of the last ones. Collective: every rank must call this; all throw
/// the first error in the file.
///
/// \throws io_error, and exceptions of `take`
[[nodiscard]] std::vector<io::row_place> rows_in_turn(
    const communicator& all, const file_of_rows& of,
    const std::function<void(const io::row_block&)>& take,
    const std::function<void(const io::point_blocks&)>& done = {});

}  // namespace treeform::detail::stream
