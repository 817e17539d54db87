#pragma once
/// \file
/// What was welded in words, for the terminal.

#include "tools/tf-weld/welding.hpp"

#include <string>

namespace tools {

/// "12,345 of 100,000 points removed, 87,655 kept (within 0.5)"
[[nodiscard]] std::string verdict(const welding& w, const weld_request& request);

/// Warns of what welding has done to the faces, and of points that are nowhere.
void warn_of_defects(job& work, const welding& w);

/// What -v adds to the verdict.
void say_details(job& work, const welding& w);

}  // namespace tools
