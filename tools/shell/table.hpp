#pragma once
/// \file
/// What became of many inputs, as a table for people.

#include "tools/shell/common_options.hpp"
#include "tools/shell/entries.hpp"

#include <string>
#include <vector>

namespace tools {

/// A line for each of `files`, entries of a report, with numbers one below the other, and one with
/// their totals.
[[nodiscard]] std::string table_of(const json& files, const std::vector<table_column>& columns);

}  // namespace tools
