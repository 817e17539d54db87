#pragma once
/// \file
/// Rows behind the points of a file whose places only those know who have read what is ahead of
/// them, and likewise points with lists.

#include <libmesh/io/detect.hpp>
#include <libmesh/io/point_rows.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/stream/communicator.hpp>

#include <filesystem>
#include <functional>
#include <optional>
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
    const std::function<void(const row_block&)>& take,
    const std::function<void(const io::point_blocks&)>& done = {});

/// Looks at files before any rank can read its share: at the lines of a text that begin in its
/// share of the bytes, and likewise at points with lists, one after the other. Returns what is
/// known of each file when all have looked; none of what is no text of points or of a PLY, and of
/// what cannot be read: what is wrong is said where it is read from the front. Collective: every
/// rank must call this.
[[nodiscard]] std::vector<std::optional<io::record_index>> survey_records(
    const std::vector<std::filesystem::path>& paths, const io::reading& how,
    const communicator& all);

}  // namespace treeform::detail::stream
