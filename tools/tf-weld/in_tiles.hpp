#pragma once
/// \file
/// The work on a cloud that does not fit into memory.

#include "tools/tf-weld/out_of_core.hpp"
#include "tools/tf-weld/settings.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld_stream.hpp>

#include <filesystem>

namespace tools {

/// Where tiles go: as asked, or beside the output.
[[nodiscard]] std::filesystem::path folder_for(const job& work, const weld_request& request,
                                               const tile_options& tiles);

/// Welds the cloud in `inputs`, whose header is known, in tiles on the disk. \throws failure
[[nodiscard]] exit_status weld_in_tiles(job& work, const weld_request& request,
                                        const tile_options& tiles, const tf::cloud_inputs& inputs,
                                        const tf::mesh_file& header);

}  // namespace tools
