#pragma once
/// \file
/// The names of columns above a table of numbers.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// The names in a line: split at semicolons, else at commas, else at tabs, else at blanks,
/// whichever it has; without quotes, and with underscores for the blanks within.
[[nodiscard]] std::vector<std::string> split_heading(std::string_view line);

/// Numbers of the columns that are called x, y and z, in any case; none unless all three are there.
[[nodiscard]] std::optional<std::array<std::size_t, 3>> find_axes(
    const std::vector<std::string>& names);

}  // namespace treeform::detail::io
