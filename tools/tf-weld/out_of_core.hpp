#pragma once
/// \file
/// The work on clouds that do not fit into memory.

#include "tools/common/run.hpp"
#include "tools/tf-weld/settings.hpp"

#include <cstdint>
#include <filesystem>

namespace tools {

/// What a user may say about it.
struct tile_settings {
    std::filesystem::path folder{};     ///< to work in; empty: beside the output
    std::uint64_t points_per_tile = 0;  ///< for tests: tiles in any case, of about this size
    std::uint64_t stop_at = 0;          ///< for tests: be killed at this step
};

/// Welds where it can be done best: in memory what fits into what --memory allows (else three
/// fourths of the machine's), and what only memory will do; other clouds in tiles on the disk. The
/// result is the same to the byte.
///
/// \throws failure
[[nodiscard]] exit_status weld_somewhere(job& work, const weld_request& request,
                                         const tile_settings& tiles);

}  // namespace tools
