#pragma once
/// \file
/// What a user of tf-cut asks for, what is made of an input, and how it is reported and written.

#include "tools/shell/change_limits.hpp"
#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/shell/run.hpp"
#include "tools/shell/usable_input.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tools {

enum class cut_mode : std::uint8_t {
    half,
    section,
    isolines,
    pieces,
    parts,
    info,
    simplify,
    offset,
    hollow,
    thicken
};
inline constexpr std::array<const char*, 10> cut_modes{"half",   "section", "isolines", "pieces",
                                                       "parts",  "info",    "simplify", "offset",
                                                       "hollow", "thicken"};
inline constexpr std::array<const char*, 3> thick_sides{"both", "front", "back"};

enum class kept_half : std::uint8_t { both, below, above };
inline constexpr std::array<const char*, 3> kept_halves{"both", "below", "above"};

/// How `info` looks for the thinnest wall.
enum class measured_walls : std::uint8_t { ray, sphere, none };
inline constexpr std::array<const char*, 3> wall_measures{"ray", "sphere", "none"};

/// Of `simplify`, `offset`, `hollow` and `thicken`.
struct shape_settings {
    tools::distance distance{};  ///< that of `offset` may be below 0
    std::optional<double> resolution{};
    std::vector<std::pair<tf::point3, double>> drains{};
    double shift = 0.0;  ///< of `thicken`, in thicknesses
    std::uint64_t fewest_faces = 0;
};

/// Of `isolines`.
struct line_settings {
    std::string value = "height";  ///< or "distance", or the name of a property of vertices
    std::string to{};              ///< the file that `distance` is from
    std::vector<double> levels{};
    std::uint64_t count = 0;  ///< of levels, where none are given
};

/// Of `parts`.
struct part_settings {
    double min_volume = 0.0;
    std::uint64_t largest = 0;  ///< 0: all
};

struct cut_settings {
    std::string mode_text{};
    cut_mode mode = cut_mode::half;
    tf::oriented_plane plane{};
    std::vector<double> heights{0.0};  ///< of planes
    double layers = 0.0;               ///< thickness, or 0
    std::optional<tf::point3> bed{};
    kept_half keep = kept_half::both;
    bool open = false;
    tools::change_limits limits{};
    part_settings parts{};
    shape_settings shape{};
    line_settings lines{};
    measured_walls walls = measured_walls::ray;
    std::string caps{};  ///< name of the property with the plane of each cap; or none
    std::filesystem::path output{};

    /// One half, which may be empty: an empty file then, as of a boolean.
    [[nodiscard]] bool keeps_one() const {
        return mode == cut_mode::half && keep != kept_half::both;
    }
};

/// What the command line may say; what it asks for is to go together. \throws failure (bad_usage)
void add_settings(command_line& line, cut_settings& s);
void check_request(const command_line& line, cut_settings& s, common_options& options);

/// The option of the distance of `simplify`, `offset`, `hollow` and `thicken`.
[[nodiscard]] const char* option_of(cut_mode mode);

/// As `signed_volume`; none of an open surface, of which it would depend on the origin.
[[nodiscard]] std::optional<double> volume_of(const tf::mesh& mesh);

/// Of the box around it.
[[nodiscard]] double diagonal_of(const usable_input& input);

/// A piece or part.
struct cut_off {
    tf::mesh mesh{};
    std::vector<std::uint32_t> face_source{};
    std::vector<std::uint32_t> vertex_source{};
    std::vector<std::uint32_t> face_of_new_vertex{};  ///< of `simplify`
    std::vector<std::uint32_t> corner_source{};       ///< likewise
    std::vector<std::uint32_t> cap{};                 ///< as `cut_piece::cap`; empty of parts
    std::optional<double> volume{};                   ///< none of an open surface
    double area = 0.0;
    tf::certificate certificate{};
};

/// With its volume and area; of what is not from the input, sources are empty.
[[nodiscard]] cut_off cut_off_of(tf::mesh&& mesh, std::vector<std::uint32_t>&& face_source,
                                 std::vector<std::uint32_t>&& vertex_source,
                                 tf::certificate&& known);

/// Of each vertex, along the normal above the plane.
[[nodiscard]] std::vector<double> heights_of(const cut_settings& s, const usable_input& input);
/// The least and greatest value of a corner.
[[nodiscard]] std::array<double, 2> range_of(const usable_input& input,
                                             const std::vector<double>& values);

/// Keys of a report for which nothing has been done yet.
void enter_blank_report(job& work, const cut_settings& s, const usable_input& input);

/// Enters and says what there is.
void say_section(job& work, const cut_settings& s, const usable_input& input,
                 const tf::section_result& made);
void say_pieces(job& work, const cut_settings& s, const usable_input& input,
                const std::vector<cut_off>& pieces);
void say_info(job& work, const cut_settings& s, const usable_input& input);

/// What `make` returns; where its arguments do not suit the mesh, the option is to blame.
template <class Make>
[[nodiscard]] auto suitable(const char* option, const Make& make) {
    try {
        return make();
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what();
        refuse(std::string(option) + text.substr(std::min(text.size(), text.find(": "))));
    }
}

/// Loops in planes, and lines where a value has levels: made, said, shown and written.
exit_status make_section(job& work, const usable_input& input, cut_settings s);
exit_status make_isolines(job& work, const usable_input& input, const cut_settings& s);

/// How lines are written; json to standard output.
[[nodiscard]] std::string lines_format(const std::filesystem::path& path);

/// What `simplify`, `offset`, `hollow` and `thicken` make; enters the distances.
cut_off shape_of(job& work, const cut_settings& s, const usable_input& input,
                 tf::precision precision);

/// Whether "%d" is in the name, or "%03d" with so many digits at least.
[[nodiscard]] bool has_number(const std::filesystem::path& path);

/// Paths of `count` files with numbers instead, none of which is an input; the path itself where it
/// has no place for one. \throws failure
[[nodiscard]] std::vector<std::filesystem::path> numbered_paths(job& work,
                                                                const std::filesystem::path& path,
                                                                std::size_t count);

/// Writes pieces, each to a file of its own, or all to one. \throws failure
void write_pieces(job& work, const cut_settings& s, const usable_input& input,
                  std::vector<cut_off>& pieces);

/// Checks that several pieces can be written: --output has "%d", or its format has objects. `what`
/// is "pieces" or "parts". \throws failure (bad_usage)
void check_pieces_path(const common_options& options, const std::string& what);

/// Sides of loops or isolines, to be drawn.
struct drawn_lines {
    std::string name{};
    std::vector<std::array<tf::point3, 2>> sides{};
};

/// Page and picture, where they are asked for.
void write_page(job& work, const usable_input& input, const std::string& verdict, bool good,
                const std::vector<cut_off>& pieces, const drawn_lines* lines);

}  // namespace tools
