#pragma once
/// \file
/// The work on inputs that fit into memory.

#include "tools/shell/run.hpp"
#include "tools/tf-weld/settings.hpp"

#include <string>

namespace tools {

/// Reads, welds, writes what was asked for, enters it all in the report. Says `remark` first, where
/// there is one.
/// \throws failure
[[nodiscard]] exit_status weld_in_memory(job& work, const weld_request& request,
                                         const std::string& remark = {});

}  // namespace tools
