#pragma once
/// \file
/// What has been welded in tiles, on its way to the files that were asked for.

#include "tools/tf-weld/outputs.hpp"
#include "tools/tf-weld/tile_steps.hpp"

#include <filesystem>

namespace tools {

/// Removes what a process that was killed while it gave back has not brought to an end.
void remove_leftovers(const work_folder& folder);

/// The last pass over the input: what is kept, and what else is asked for.
/// \throws failure, also where the input has changed meanwhile; std::logic_error where points in
///         are not points kept and points removed
void give_back(job& work, const weld_request& request, const std::filesystem::path& input,
               const point_survey& survey, tile_steps& steps, tiles_welded& welded,
               const work_folder& folder);

}  // namespace tools
