#pragma once
/// \file
/// Chooses the columns of a text table, and their types by the contents of cells.

#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// A value of a table; for integers also its exact 64 bits.
struct text_cell {
    double value = 0.0;
    std::uint64_t bits = 0;
};

/// Parses a 64-bit integer without point and exponent into `c`; false if the text is not one.
[[nodiscard]] bool take_whole(const char* at, const char* end, text_cell& c, text_column& fact);

/// Gives columns the chosen names; columns are selected by their name in the heading or by number.
/// Returns the columns of x, y and z, if these were chosen.
///
/// \throws io_error for a column that does not exist, and if only some coordinates were chosen
[[nodiscard]] std::optional<std::array<std::size_t, 3>> choose_columns(
    const source& in, std::span<const std::pair<std::string, std::string>> chosen,
    std::vector<std::string>& names);

/// Chooses the types of the data columns of `declared`; `facts` has their properties, in order.
/// 64-bit integers where doubles would round, 8 or 16 bits for colors, else doubles.
void choose_types(element& declared, std::span<const text_column> facts);

/// Adds warnings about cells that become NaN, and numbers that are rounded.
void remark_on_cells(const element& declared, std::span<const text_column> facts,
                     std::vector<io_warning>& warnings);

/// The cells of a column in a block of cells.
struct cell_places {
    std::size_t first = 0;
    std::size_t width = 0;  ///< distance to the cell of the next row
    std::size_t rows = 0;
};
void append_cells(column& to, std::span<const text_cell> cells, const cell_places& places);

/// Converts doubles that are integers of a type to that type.
void retype(column& c, scalar_type type);

}  // namespace treeform::detail::io
