#pragma once
/// \file
/// The columns of a table of text: which are chosen, and of which type each is by what is in its
/// cells.

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
#include <utility>
#include <vector>

namespace treeform::detail::io {

/// A value of a table; a whole number also bit for bit.
struct text_cell {
    double value = 0.0;
    std::uint64_t bits = 0;
};

/// Whether the text is a whole number of 64 bits, without point and exponent, which `c` gets.
[[nodiscard]] bool take_whole(const char* at, const char* end, text_cell& c, text_column& fact);

/// Gives columns the names that were chosen for them, by what the heading calls them or by their
/// number; the columns of x, y and z, if they are among these.
///
/// \throws io_error for one that is not there, and for some of the coordinates without the others
[[nodiscard]] std::optional<std::array<std::size_t, 3>> choose_columns(
    const source& in, std::span<const std::pair<std::string, std::string>> chosen,
    std::vector<std::string>& names);

/// Types for columns of `declared` that are data, of which `facts` are in their order: integers of
/// 64 bits where doubles would round, bytes or 16 bits of colors, else doubles.
void choose_types(element& declared, std::span<const text_column> facts);

/// Says which cells are NaN, and which numbers are rounded.
void remark_on_cells(const element& declared, std::span<const text_column> facts,
                     std::vector<io_warning>& warnings);

/// Which of some cells are those of a column.
struct cell_places {
    std::size_t first = 0;
    std::size_t width = 0;  ///< to the cell of the next row
    std::size_t rows = 0;
};
void append_cells(column& to, std::span<const text_cell> cells, const cell_places& places);

/// Gives doubles that are whole numbers of a type that type.
void retype(column& c, scalar_type type);

}  // namespace treeform::detail::io
