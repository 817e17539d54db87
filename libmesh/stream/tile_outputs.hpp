#pragma once
/// \file
/// Writes the outputs of a weld in tiles.

#include <libmesh/stream/kept_rows.hpp>
#include <libmesh/stream/tile_faces.hpp>
#include <libmesh/stream/tile_steps.hpp>

namespace treeform::detail::stream {

/// Removes unfinished outputs of a process that was killed while it wrote them.
void remove_leftovers(const work_folder& folder);

/// The last pass over the input: writes the kept points and the other requested outputs. `rows` are
/// the kept rows of groups; null if their first points are kept. `faces` are those of a welded
/// mesh; null for a cloud. Records in `made` what was written.
///
/// \throws io_error, also if the input changed meanwhile; cancelled; std::logic_error unless input
///         points = kept + removed points
void give_back(cancellable_progress& pace, const tile_task& task,
               const weld_stream_outputs& outputs, tile_steps& steps, tiles_welded& welded,
               kept_rows* rows, tile_faces* faces, const work_folder& folder,
               weld_stream_result& made);

}  // namespace treeform::detail::stream
