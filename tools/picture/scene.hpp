#pragma once
/// \file
/// What a page shows. A tool fills a `scene`, `html` makes one file of it, and the script in
/// tools/picture/viewer shows that. The README.md there says how it is packed.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tools {

/// A color with its entry, and its switch, in the legend; others name it by its number. It is in
/// the legend where something has it.
struct scene_class {
    std::string name{};
    std::string color{};  ///< "#rrggbb"
    std::string count{};  ///< shown behind the name: "12 faces"
    /// What was not found, but is around that: thinned out where there is much of it, and one can
    /// see through it.
    bool context = false;
    bool shown = true;  ///< at first
};

/// "#rrggbb" for the `number`th of things of one sort, such as inputs. All of 250 differ.
[[nodiscard]] std::string scene_color(std::size_t number);

/// Shown when a face or point is clicked that is in no file.
inline constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

/// Faces. Where a tool shows before and after, `variant` says which of the two it is.
struct scene_mesh {
    tf::mesh_view mesh{};                 ///< coordinates of faces are finite
    std::vector<std::uint8_t> kind{};     ///< [F] its class; or one for all
    std::vector<std::uint32_t> number{};  ///< [F] shown when it is clicked; empty: that in `mesh`
    std::string name{};                   ///< "face 12 of NAME"
    std::string group_word{};             ///< "region": then `group` is shown, too
    std::vector<std::uint32_t> group{};   ///< [F]
    std::vector<double> value{};          ///< [V] of the map, NaN where there is none; or empty
    std::string variant{};                ///< "before", "after" or empty
    bool ghost = false;                   ///< faint, and not clicked
};

/// Segments of one class.
struct scene_lines {
    std::uint8_t kind = 0;
    std::vector<std::array<tf::point3, 2>> ends{};
    std::string word{};                   ///< "edge": then they can be clicked
    std::vector<std::uint32_t> number{};  ///< as of faces
    std::string labeled{};                ///< "number" or "length" is written beside each
    std::string text{};                   ///< instead of the length, which is that of the drawing
    std::string variant{};
    double width = 2.0;  ///< in pixels
};

/// Points of clouds, and contacts.
struct scene_dots {
    std::vector<tf::point3> points{};  ///< those that are not finite are left out
    std::vector<std::uint8_t> kind{};  ///< as of faces
    std::vector<std::uint32_t> number{};
    std::string word = "point";
    std::string group_word{};
    std::vector<std::uint32_t> group{};
    std::vector<double> value{};
    std::vector<tf::point3> normal{};  ///< of length 1, drawn as a line; or empty
    std::string variant{};
    double width = 5.0;
};

struct scene_arrow {
    tf::point3 from{};
    tf::point3 to{};
    std::string text{};
    std::uint8_t kind = 0;
};

struct scene_label {
    tf::point3 at{};
    std::string text{};
    std::uint8_t kind = 0;
};

/// The colors of values, from `low` to `high`; values beyond have those at the ends.
struct scene_map {
    std::string name{};
    double low = 0.0;
    double high = 1.0;
    std::vector<std::string> colors{};            ///< at equal steps, two or more
    std::optional<std::array<double, 2>> band{};  ///< within it, all is green
};

struct scene_histogram {
    std::string title{};
    double low = 0.0;
    double high = 1.0;
    std::vector<std::uint64_t> counts{};
    std::vector<std::pair<double, std::string>> marks{};
    std::string note{};
    bool logarithmic = false;  ///< intervals have equal ratios; low > 0
};

/// Cells are texts and numbers. One can fly to the box of a row.
struct scene_row {
    std::vector<nlohmann::ordered_json> cells{};
    std::optional<tf::box3> box{};
};

struct scene_table {
    std::string title{};
    std::vector<std::string> columns{};
    std::vector<scene_row> rows{};
    std::string note{};
};

struct scene {
    std::string title{};
    std::string verdict{};
    bool good = false;
    std::string unit{};                  ///< "mm"; empty where it is not known
    bool y_is_up = false;                ///< the view starts with z up otherwise
    std::string place_word{};            ///< "region": a button flies to the next row
    std::vector<scene_class> classes{};  ///< at most 250
    std::vector<scene_mesh> meshes{};
    std::vector<scene_lines> lines{};
    std::vector<scene_dots> dots{};
    std::vector<scene_arrow> arrows{};
    std::vector<scene_label> labels{};
    std::optional<scene_map> map{};
    std::vector<scene_histogram> histograms{};
    std::vector<scene_table> tables{};
    std::vector<std::pair<std::string, std::string>> facts{};
};

[[nodiscard]] bool is_finite(const tf::point3& p);

/// The box of faces, lines, dots and arrows, all or `shown_alone`; at 0 where that is nothing.
[[nodiscard]] tf::box3 box_of(const scene& shown, bool shown_alone);

/// Of each class, whether something has it.
[[nodiscard]] std::vector<bool> used_classes(const scene& shown);

/// Of each class, whether all that has it is colored by values instead.
[[nodiscard]] std::vector<bool> mapped_classes(const scene& shown);

using scene_segment = std::array<tf::point3, 2>;

/// Edges of one face. Those that are linked by points bound one hole, or border one sheet.
struct open_edges {
    std::vector<scene_segment> ends{};
    std::vector<std::uint32_t> hole{};  ///< [E] its number, from 0, in the order of first edges
    std::uint32_t holes = 0;
};

/// The edges of one face; points with equal coordinates are one.
///
/// \pre  coordinates of faces are finite
/// \cost O(V + F log F)
[[nodiscard]] open_edges find_open_edges(tf::mesh_view mesh);

}  // namespace tools
