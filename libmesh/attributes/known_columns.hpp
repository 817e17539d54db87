#pragma once
/// \file
/// What formats call the columns of points that they all know, and of which type they are there:
/// one table for readers, writers and all that looks for a normal or a color by its name.
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

/// Formats that have words of their own; all others have those of PLY.
enum class dialect : std::uint8_t { ply, pcd, las };

/// How a dialect has a column.
struct column_words {
    std::string_view name;
    std::optional<scalar_type> type{};  ///< none: any
};

struct known_column {
    column_use use;
    std::array<column_words, 3> in;  ///< [dialect]

    [[nodiscard]] const column_words& words(dialect d) const {
        return in[static_cast<std::size_t>(d)];
    }
};

/// Colors in PCD are packed: "rgb", or with an alpha "rgba".
inline constexpr std::string_view packed_color = "rgb";
inline constexpr std::string_view packed_color_with_alpha = "rgba";

/// What 1 in a channel of 8 bits is in one of 16, which are 255 and 65535 where they are full.
inline constexpr double bytes_in_word = 257.0;

[[nodiscard]] std::span<const known_column> known_columns();

/// The column that a name means in any dialect, in any case, with underscores or without, and
/// behind "scalar_" as CloudCompare has it; null where none is known.
[[nodiscard]] const known_column* find_known(std::string_view name);

/// Whether a name is one of a normal or a texture coordinate, or of a color, packed or not.
[[nodiscard]] bool is_use(std::string_view name, column_use use);
/// The use that "normal", "uv" and "color" stand for.
[[nodiscard]] std::optional<column_use> use_called(std::string_view name);
/// The axis of a name of a normal: 0, 1, 2.
[[nodiscard]] std::optional<std::size_t> normal_axis(std::string_view name);

/// "pcd-binary" and "pcd" are PCD; "laz" is LAS.
[[nodiscard]] dialect dialect_of(std::string_view format);

/// Least and greatest of columns whose scale shows in their values: colors that are floats or have
/// 16 bits, and intensities that are floats. `seen` is of other rows, which are counted in.
void look_at_ranges(const element& rows, std::vector<value_range>& seen);

/// How columns of points are said in another format.
class translation {
  public:
    /// From `from` to `to`, both as `mesh_file::format` or an extension. A format is not translated
    /// to itself: what a file has stays as it is. `ranges` is of all points, as far as it is known.
    translation(const element& columns, std::string_view from, std::string_view to,
                std::span<const value_range> ranges)
        : translation(columns, from, to, ranges, {}, {}) {}
    /// Columns named in `drop` are left out, and those in `rename` have another name before
    /// anything else is done.
    /// \throws std::invalid_argument naming one that is not there, or is there twice then
    translation(const element& columns, std::string_view from, std::string_view to,
                std::span<const value_range> ranges, std::span<const std::string> drop,
                std::span<const std::pair<std::string, std::string>> rename);

    /// Whether anything is to be done.
    [[nodiscard]] bool changes() const { return changes_; }
    /// These rows in the words of the other format; of no rows, the columns that there will be.
    [[nodiscard]] element apply(const element& rows) const;
    /// What is scaled or rounded, a sentence each.
    [[nodiscard]] const std::vector<io_warning>& warnings() const { return warnings_; }

  private:
    /// How a channel of a color becomes one of 8 bits. In LAS those are the high ones of 16.
    enum class color_scale : std::uint8_t { bytes, high_byte, word, unit };
    enum class way : std::uint8_t { copied, cast, scaled, channel, packed, unpacked };
    struct target {
        column declared{};
        way how = way::copied;
        std::vector<std::size_t> from{};  ///< columns that it is made of
        double factor = 1.0;
        unsigned shift = 0;  ///< in what is packed
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
    bool is_same_;  ///< format
    bool changes_ = false;
    bool keeps_floats_ = false;  ///< of colors
    bool keeps_words_ = false;   ///< of 16 bits, of colors
    color_scale scale_ = color_scale::bytes;
    std::vector<target> targets_{};
    std::string narrowed_{};  ///< names of columns that become float32
    std::vector<io_warning> warnings_{};
};

}  // namespace treeform::detail::attribute
