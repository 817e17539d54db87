#pragma once
/// \file
/// Numbers in pictures.

#include <string>

namespace tools {

/// Four digits, and the unit where there is one.
[[nodiscard]] std::string with_unit(double value, const std::string& unit);

}  // namespace tools
