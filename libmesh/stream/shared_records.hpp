#pragma once
/// \file
/// Files that each rank looks at before any of them can read its share: at the lines of a text that
/// begin in its share of the bytes, and likewise at points with lists, one after the other.

#include <libmesh/io/detect.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/stream/communicator.hpp>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace treeform::detail::stream {

/// What is known of each file when all have looked; none of what is no text of points or of a PLY,
/// and of what cannot be read: what is wrong is said where it is read from the front. Collective:
/// every rank must call this.
[[nodiscard]] std::vector<std::optional<io::record_index>> survey_records(
    const std::vector<std::filesystem::path>& paths, const io::reading& how,
    const communicator& all);

}  // namespace treeform::detail::stream
