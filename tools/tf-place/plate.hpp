#pragma once
/// \file
/// All MOVING put beside each other on a plate: the mode arrange.

#include "tools/common/run.hpp"
#include "tools/tf-place/settings.hpp"

namespace tools {

/// Reads all inputs, arranges and writes them. \returns found when not all fit
[[nodiscard]] exit_status arrange_all(job& work, const place_settings& settings);

}  // namespace tools
