#pragma once
/// \file
/// The names and types of common point columns in each format: one table for readers, writers, and
/// all code that finds a normal or a color by name.
///
/// \source PCL 1.13, point_types.hpp (PCD); LAS Specification 1.4 R15, and the extra bytes of
///         CloudCompare 2.13 and PDAL 2.5 (LAS); MeshLab 2022, vcglib import_ply.h (PLY, OFF, OBJ)

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::attribute {

enum class column_use : std::uint8_t { color, normal, texture, number };

/// Formats with their own column names; all others use those of PLY.
enum class dialect : std::uint8_t { ply, pcd, las };

/// The name and type of a column in a dialect.
struct column_words {
    std::string_view name;
    std::optional<scalar_type> type{};  ///< empty: any type
};

struct known_column {
    column_use use;
    std::array<column_words, 3> in;  ///< [dialect]

    [[nodiscard]] const column_words& words(dialect d) const {
        return in[static_cast<std::size_t>(d)];
    }
};

/// Colors in PCD are packed into one column: "rgb", or "rgba" with alpha.
inline constexpr std::string_view packed_color = "rgb";
inline constexpr std::string_view packed_color_with_alpha = "rgba";

/// The column that a name means in any dialect; null if unknown. Ignores case, underscores and the
/// prefix "scalar_" of CloudCompare.
[[nodiscard]] const known_column* find_known(std::string_view name);

/// Whether a name is that of a column with the given use: a normal, a texture coordinate or a
/// color, packed or not.
[[nodiscard]] bool is_use(std::string_view name, column_use use);
/// The use named "normal", "uv" or "color"; empty for other names.
[[nodiscard]] std::optional<column_use> use_called(std::string_view name);
/// The axis (0, 1 or 2) of a column of normals; empty for other names.
[[nodiscard]] std::optional<std::size_t> normal_axis(std::string_view name);

/// Extends `seen`, the ranges of earlier rows, by the values of `rows`. Only columns whose scale
/// must be inferred from their values have ranges: colors in float or 16 bits, and intensities in
/// float.
void look_at_ranges(const element& rows, std::vector<value_range>& seen);

/// Conversion of point columns to the names, types and scales of another format.
class translation {
  public:
    /// Converts from `from` to `to`, each named as in `mesh_file::format` or by extension. If both
    /// are the same format, columns are not converted. `ranges` has the ranges of all points, as
    /// far as known.
    /// Columns named in `drop` are omitted and those in `rename` are renamed, before the
    /// conversion.
    /// \throws std::invalid_argument naming a column that does not exist, or a name that exists
    ///         twice after renaming
    translation(const element& columns, std::string_view from, std::string_view to,
                std::span<const value_range> ranges, std::span<const std::string> drop = {},
                std::span<const std::pair<std::string, std::string>> rename = {});

    /// Whether the conversion changes anything.
    [[nodiscard]] bool changes() const { return changes_; }
    /// Converts rows. Without rows, the result has the columns of the converted format.
    [[nodiscard]] element apply(const element& rows) const;
    /// One warning for each scaled or rounded column.
    [[nodiscard]] const std::vector<io_warning>& warnings() const { return warnings_; }

  private:
    /// Conversion of a color channel to 8 bits. In LAS these are the high byte of 16 bits.
    enum class color_scale : std::uint8_t { bytes, high_byte, word, unit };
    enum class way : std::uint8_t { copied, cast, scaled, channel, packed, unpacked };
    struct target {
        column declared{};
        way how = way::copied;
        std::vector<std::size_t> from{};  ///< source columns
        double factor = 1.0;
        unsigned shift = 0;  ///< bit position in the packed value
    };

    void plan(const element& columns, std::vector<bool>& done);
    void plan_colors(const element& columns, std::vector<bool>& done);
    void plan_packed_colors(const element& columns, std::vector<bool>& done);
    void plan_column(const element& columns, std::size_t i);
    void plan_intensity(target& t, const column& c);
    void choose_scale(const std::vector<const column*>& channels);
    void say(std::string code, std::string text);
    [[nodiscard]] const value_range* range_of(std::string_view column) const;
    void choose(element& columns, std::span<const std::string> drop, std::vector<bool>& done);
    [[nodiscard]] std::uint8_t byte_of(const column& c, std::size_t row) const;
    void fill(column& to, const target& t, const element& rows) const;

    std::string to_;
    dialect from_words_;
    dialect to_words_;
    std::span<const value_range> ranges_;
    std::span<const std::pair<std::string, std::string>> renamed_;
    bool is_same_;  ///< whether both formats are the same
    bool changes_ = false;
    bool keeps_floats_ = false;  ///< whether colors stay float
    bool keeps_words_ = false;   ///< whether colors stay 16 bits
    color_scale scale_ = color_scale::bytes;
    std::vector<target> targets_{};
    std::string narrowed_{};  ///< names of columns that become float32
    std::vector<io_warning> warnings_{};
};

}  // namespace treeform::detail::attribute
