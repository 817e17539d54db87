#pragma once
/// \file
/// What a user of tf-cut asks for, what is made of an input, and how it is reported and written.

#include "tools/common/change_limits.hpp"
#include "tools/common/parse_value.hpp"
#include "tools/common/run.hpp"
#include "tools/common/usable_input.hpp"
#include <treeform/mesh/carry.hpp>
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
    pieces,
    parts,
    info,
    simplify,
    offset,
    hollow,
    thicken
};
inline constexpr std::array<const char*, 9> cut_modes{
    "half", "section", "pieces", "parts", "info", "simplify", "offset", "hollow", "thicken"};
inline constexpr std::array<const char*, 3> thick_sides{"both", "front", "back"};

enum class kept_half : std::uint8_t { both, below, above };
inline constexpr std::array<const char*, 3> kept_halves{"both", "below", "above"};

/// Of `simplify`, `offset`, `hollow` and `thicken`.
struct shape_settings {
    tools::distance distance{};  ///< that of `offset` may be below 0
    std::optional<double> resolution{};
    std::vector<tf::drain> drains{};
    tf::thick_side side = tf::thick_side::both;
    std::uint64_t fewest_faces = 0;
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
    double min_volume = 0.0;
    std::uint64_t largest = 0;  ///< 0: all
    shape_settings shape{};
    std::string caps{};  ///< name of the property with the plane of each cap; or none
    std::filesystem::path output{};
};

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
    std::vector<std::uint32_t> cap{};                 ///< as `cut_piece::cap`; empty of parts
    std::optional<double> volume{};                   ///< none of an open surface
    double area = 0.0;
    tf::certificate certificate{};
};

/// Keys of a report for which nothing has been done yet.
void enter_blank_report(job& work, const cut_settings& s, const usable_input& input);

/// Enters and says what there is.
void say_section(job& work, const cut_settings& s, const usable_input& input,
                 const tf::section_result& made);
void say_pieces(job& work, const cut_settings& s, const usable_input& input,
                const std::vector<cut_off>& pieces);
void say_info(job& work, const usable_input& input);

/// What `simplify`, `offset`, `hollow` and `thicken` make; enters the distances.
cut_off shape_of(job& work, const cut_settings& s, const usable_input& input,
                 tf::precision precision);

/// Writes pieces, each to a file of its own, or all to one. \throws failure
void write_pieces(job& work, const cut_settings& s, const usable_input& input,
                  std::vector<cut_off>& pieces);

/// That pieces can be written so: --output with "%d", or a format with objects. \throws failure
/// (bad_usage)
void check_pieces_path(const common_options& options, std::size_t pieces);

/// Page and picture, where they are asked for.
void write_page(job& work, const usable_input& input, const std::string& verdict, bool good,
                const std::vector<cut_off>& pieces, const tf::section_result* section);

}  // namespace tools
