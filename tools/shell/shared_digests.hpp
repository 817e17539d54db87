#pragma once
/// \file
/// Digests of inputs, found by many.

#include "tools/shell/tile_options.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tools {

/// SHA-256 of each file; empty of one that cannot be read, and of all where no report asks for
/// them. Each rank reads its share of all bytes, one after the other, and hands on what it has come
/// to. Collective: every rank must call this, and all get them.
[[nodiscard]] std::vector<std::string> digests_for_report(
    const std::vector<std::filesystem::path>& paths, const tile_options& tiles);

}  // namespace tools
