#pragma once
/// \file
/// The work on clouds that do not fit into memory.

#include "tools/shell/run.hpp"
#include "tools/shell/tile_options.hpp"
#include "tools/tf-weld/settings.hpp"

namespace tools {

/// Welds where it can be done best: in memory what fits into what --memory allows (else three
/// fourths of the machine's), and what only memory will do; other clouds in tiles on the disk. The
/// result is the same to the byte.
///
/// \throws failure
[[nodiscard]] exit_status weld_somewhere(job& work, const weld_request& request,
                                         const tile_options& tiles);

}  // namespace tools
