#pragma once
/// \file
/// Surveys files so that each rank can then read its share: lines of text, each rank those that
/// begin in its share of the bytes; and points with lists, rank after rank.

#include <libmesh/io/reading.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/stream/communicator.hpp>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace treeform::detail::stream {

/// The index of the records of each file. None for files that are neither text nor a PLY with
/// lists, and for files that cannot be read, whose errors are reported when they are read.
/// Collective: every rank must call this.
[[nodiscard]] std::vector<std::optional<io::record_index>> survey_records(
    const std::vector<std::filesystem::path>& paths, const io::reading& how,
    const communicator& all);

}  // namespace treeform::detail::stream
