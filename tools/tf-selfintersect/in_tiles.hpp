#pragma once
/// \file
/// The search of a file that does not fit into memory.

#include "tools/shell/tile_options.hpp"
#include "tools/tf-selfintersect/search.hpp"

#include <optional>

namespace tools {

/// Whether the input is to be searched in tiles: where it was asked for, or where memory may not be
/// enough and tiles can do it. \throws failure (bad_usage) where they cannot do what was asked for
[[nodiscard]] bool needs_tiles(job& work, const search_settings& settings,
                               const tile_options& tiles, bool changes_mesh);

/// Does this process's share of a search by many: makes the tiles, or searches one. \throws failure
void share_search(job& work, const search_settings& settings, const tile_options& tiles);

/// What `search` finds, but of the mesh only the faces that meet others. Enters in `work.entry`
/// what reading a file does. \throws failure
[[nodiscard]] findings search_in_tiles(job& work, const search_settings& settings,
                                       const tile_options& tiles,
                                       const std::filesystem::path& folder);

}  // namespace tools
