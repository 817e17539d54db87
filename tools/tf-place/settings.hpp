#pragma once
/// \file
/// What a user of tf-place asks for.

#include "tools/common/command_line.hpp"
#include "tools/common/common_options.hpp"
#include "tools/common/parse_value.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <optional>
#include <string>
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
    std::string start{};
    std::filesystem::path matrix{};
    bool scene = false;
    tf::align_options fit{};
    std::optional<distance> max_distance{};
    tf::pack_options arrange{};
    tf::lay_flat_options lay{};  ///< which side, and the spin
    bool largest_side = false;
    /// Flat faces that were turned and rounded, to float32 mostly, are one side of the hull again.
    distance flatness{.given = "0.0001%", .value = 1e-6, .relative = true};

    /// Whether the bed stops MOVING: `drop` without fixed meshes, or where --bed is given.
    [[nodiscard]] bool has_bed() const {
        return mode == place_mode::drop && (bed.has_value() || fixed.empty());
    }
};

[[nodiscard]] const char* name_of(place_mode mode);

/// The options in their groups, except for those that all tools share.
void add_options(command_line& line, place_settings& settings, common_options& options);

/// Takes "pack", "align" and "separate" for arrange, fit and clear, and refuses options that would
/// do nothing rather than pass them over. \throws failure (bad_usage)
void check_settings(const command_line& line, place_settings& settings, common_options& options);

}  // namespace tools
