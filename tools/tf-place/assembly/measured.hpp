#pragma once
/// \file
/// What `measure` says beyond contact and distance: how deep, how many points inside, and how far
/// each point is from the fixed surface.

#include "tools/shell/command_line.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tools {

struct deviation_settings {
    std::filesystem::path distances{};
    std::optional<std::array<double, 2>> band{};
    bool no_depth = false;

    [[nodiscard]] bool wanted() const { return !distances.empty() || band.has_value(); }
};

/// Says where a body is inside out, in whole or in part: `name` is its name.
void warn_of_inside_out(job& work, const tf::prepared_mesh& body, const std::string& name);

/// Points above and below the tolerance band; 0 without one.
[[nodiscard]] std::uint64_t out_of_band(const tf::deviation_result& r);

/// "; 3 are out of the band from -0.1 to 0.1", or nothing without a band.
[[nodiscard]] std::string band_in_words(const tf::deviation_result& r,
                                        const deviation_settings& settings);

void add_deviation_options(command_line& line, deviation_settings& settings);

/// Enters depth, points inside and deviation, where there are any or they are asked for, says them,
/// and writes the distances. `found` is the deviation, where it was asked for.
/// \returns found where a point is out of the tolerance band
[[nodiscard]] exit_status enter_measured(job& work, const deviation_settings& settings,
                                         const tf::body_set& moving, const tf::body_set& fixed,
                                         const tf::placement& at,
                                         std::optional<tf::deviation_result>& found);

}  // namespace tools
