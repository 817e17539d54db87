#pragma once
/// \file
/// The options of a turn and of mating by features, and what a report says of them.

#include "tools/shell/command_line.hpp"
#include "tools/shell/entries.hpp"
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tools {

struct turn_settings {
    tf::point3 origin{};
    tf::point3 axis{0.0, 0.0, 1.0};
    double max_angle = 360.0;
};

/// Where to look for a feature: at a face of the file, or near a point; else the largest.
struct feature_pick {
    std::optional<std::uint32_t> face{};
    std::optional<tf::point3> point{};
};

struct feature_settings {
    std::optional<tf::feature_kind> kind{};  ///< none: mate by the nearest points
    feature_pick moving{}, fixed{};
    bool flip = false;
};

void add_turn_options(command_line& line, turn_settings& settings);
[[nodiscard]] std::span<const char* const> turn_option_names();
void add_feature_options(command_line& line, feature_settings& settings);
/// Their names, `--feature` first.
[[nodiscard]] std::span<const char* const> feature_option_names();

/// The features that were found, and where they have brought MOVING.
struct mating {
    tf::mesh_feature moving{}, fixed{};
    std::size_t fixed_body = 0;
    tf::placement found{};
};

/// Finds the features and mates by them. None, and `reason` says why, where there is no feature.
[[nodiscard]] std::optional<mating> mate_by_features(const feature_settings& settings,
                                                     const tf::body_set& moving,
                                                     const tf::body_set& fixed,
                                                     const tf::placement_options& options,
                                                     std::string& reason);

[[nodiscard]] json turn_entry(const turn_settings& settings, const tf::placement& found);
[[nodiscard]] json mating_entry(const mating& features, const tf::placement& at);

}  // namespace tools
