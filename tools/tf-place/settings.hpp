#pragma once
/// \file
/// What a user of tf-place asks for.

#include "tools/common/matrix_file.hpp"
#include "tools/common/parse_value.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/transform.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

enum class place_mode { drop, lay, slide, mate, clear, measure, arrange, fit };

struct place_settings {
    std::string mode_text{};
    place_mode mode = place_mode::measure;
    std::vector<std::string> fixed{};
    std::optional<double> bed{};
    std::optional<tf::point3> direction{};
    distance clearance{};
    std::optional<distance> max_travel{};
    std::filesystem::path start{};
    std::filesystem::path matrix{};
    bool scene = false;
    tf::align_options fit{};
    std::optional<distance> max_distance{};
    bool fit_options_given = false;
    tf::pack_options arrange{};
    bool size_given = false;
    bool arrange_options_given = false;
    tf::lay_flat_options lay{};  ///< which side, and the spin
    int sides_chosen = 0;        ///< options given that choose a side
    /// Flat faces that were turned and rounded, to float32 mostly, are one side of the hull again.
    distance flatness{.given = "0.0001%", .value = 1e-6, .relative = true};
    bool flatness_given = false;

    /// Whether the bed stops MOVING: `drop` without fixed meshes, or where --bed is given.
    [[nodiscard]] bool has_bed() const {
        return mode == place_mode::drop && (bed.has_value() || fixed.empty());
    }
    [[nodiscard]] bool moves_along_direction() const {
        return mode == place_mode::drop || mode == place_mode::slide;
    }
};

/// Takes "pack", "align" and "separate" for arrange, fit and clear.
/// \throws failure (bad_usage) for a word that is no mode
[[nodiscard]] place_mode parse_mode(std::string_view text);
[[nodiscard]] const char* name_of(place_mode mode);

/// "none", "90", "45" or "any". \throws failure (bad_usage)
[[nodiscard]] tf::plate_turns parse_turns(std::string_view text);
/// "250,210" or "250,210,300", all greater than 0. \throws failure (bad_usage)
[[nodiscard]] tf::point3 parse_size3(std::string_view text);

/// Three numbers, not all 0. \throws failure (bad_usage)
[[nodiscard]] tf::point3 parse_direction(std::string_view option, std::string_view text);

}  // namespace tools
