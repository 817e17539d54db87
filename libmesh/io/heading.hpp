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

/// Numbers of the columns that hold x, y and z, by their names in any case: x, y, z; pos_x, x_coord
/// and the like; Points:0, as ParaView writes; easting, northing and elevation, as surveyors do,
/// also by their first letters. None unless all three are there.
[[nodiscard]] std::optional<std::array<std::size_t, 3>> find_axes(
    const std::vector<std::string>& names);

/// Whether there are a latitude and a longitude: angles, which are no coordinates of a point.
[[nodiscard]] bool has_angles(const std::vector<std::string>& names);

}  // namespace treeform::detail::io
