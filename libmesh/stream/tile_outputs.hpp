#pragma once
/// \file
/// What has been welded in tiles, on its way to the files that were asked for.

#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/tile_faces.hpp>
#include <libmesh/stream/tile_steps.hpp>

namespace treeform::detail::stream {

/// Removes what a process that was killed while it gave back has not brought to an end.
void remove_leftovers(const work_folder& folder);

/// The last pass over the input: what is kept, and what else is asked for. `rows` stand for groups
/// of several; null where their first points do. `faces` of a mesh that was
/// welded; null for a cloud. Enters in `made` what was written.
///
/// \throws io_error, also where the input has changed meanwhile; cancelled;
///         std::logic_error where points in are not points kept and points removed
void give_back(cancellable_progress& pace, const tile_task& task,
               const weld_stream_outputs& outputs, tile_steps& steps, tiles_welded& welded,
               kept_rows* rows, tile_faces* faces, const work_folder& folder,
               weld_stream_result& made);

}  // namespace treeform::detail::stream
