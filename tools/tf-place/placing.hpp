#pragma once
/// \file
/// MOVING among the fixed meshes: where it goes, and what that is written to.

#include "tools/common/run.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// The fixed meshes, read once for all MOVING.
struct fixed_meshes {
    tf::body_set bodies{};
    json entries = json::array();  ///< of the report, by file
    std::optional<bool> as_single{};
};

/// One MOVING, and what the library has found, in one form for all modes.
struct placing {
    const place_settings& settings;
    const tf::body_set& fixed;
    tf::body_set moving{};
    tf::placement at{};
    std::optional<tf::laid_flat> laid{};
    double flatness = 0.0;  ///< of `lay`
    std::optional<tf::align_result> aligned{};
    std::string reason{};       ///< why there is no place, in words
    tf::transform<3> matrix{};  ///< from the file to the place, with --start
};

/// Finds a place for one input, and writes it.
[[nodiscard]] exit_status place_one(job& work, const place_settings& settings, fixed_meshes& fixed);
/// Puts all inputs beside each other on a plate, and writes that. \returns found when not all fit
[[nodiscard]] exit_status arrange_all(job& work, const place_settings& settings);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const place_settings& settings);
void enter_inputs(json& entry, const tf::body_file& moving, const fixed_meshes& fixed);
void enter_place(json& entry, const placing& p);

/// "dropped by 4.5; touching bed.stl (4 contacts)", and what -v adds to it.
void say_place(job& work, const placing& p);

/// A body that goes somewhere, and by what it was moved in all: normals turn as that.
struct placed_body {
    std::size_t number = 0;
    tf::points_view points{};
    tf::transform<3> matrix{};
    tf::transform<3> all_moves{};
};

/// The files of the bodies, and of --scene, with these at their places. The report and the person
/// hear what their points have lost. Faces are colored by what they meet at the place `met`.
void write_result(job& work, const place_settings& settings, tf::body_set& moving,
                  const std::vector<placed_body>& placed, const tf::body_set& fixed,
                  const tf::placement& met);

}  // namespace tools
