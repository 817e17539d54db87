#pragma once
/// \file
/// Parses the heading (column names) of a table of numbers.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

/// The names in a line: split at the first of semicolons, commas, tabs and blanks that occurs;
/// without quotes, and with underscores for inner blanks.
[[nodiscard]] std::vector<std::string> split_heading(std::string_view line);

/// Numbers of the columns x, y and z, by their names in any case: x, y, z; pos_x, x_coord and
/// similar; Points:0, as in ParaView; easting, northing and elevation, also by their first letters.
/// None unless all three exist.
[[nodiscard]] std::optional<std::array<std::size_t, 3>> find_axes(
    const std::vector<std::string>& names);

/// Whether there are columns of latitude and longitude, which are angles, not coordinates.
[[nodiscard]] bool has_angles(const std::vector<std::string>& names);

}  // namespace treeform::detail::io
