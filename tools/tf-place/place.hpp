#pragma once
/// \file
/// What a user of tf-place asks for, where MOVING goes, and what that is written to.

#include "tools/shell/command_line.hpp"
#include "tools/shell/common_options.hpp"
#include "tools/shell/parse_value.hpp"
#include "tools/shell/run.hpp"
#include "tools/tf-place/assembly/measured.hpp"
#include "tools/tf-place/placing/lay_options.hpp"
#include "tools/tf-place/placing/motion_options.hpp"
#include "tools/tf-place/placing/pack_options.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tools {

enum class place_mode { drop, lay, slide, mate, separate, measure, pack, align, turn };

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
    deviation_settings deviation{};
    tf::align_options align{};
    std::optional<distance> max_distance{};
    pack_settings pack{};
    lay_settings lay{};
    turn_settings turn{};
    feature_settings feature{};
    /// Whether the bed stops MOVING: `drop` without fixed meshes, or where --bed is given.
    [[nodiscard]] bool has_bed() const {
        return mode == place_mode::drop && (bed.has_value() || fixed.empty());
    }
};

[[nodiscard]] const char* name_of(place_mode mode);

/// The options in their groups, except for those that all tools share.
void add_options(command_line& line, place_settings& settings, common_options& options);

/// Refuses options that would do nothing rather than pass them over. \throws failure (bad_usage)
void check_settings(const command_line& line, place_settings& settings, common_options& options);

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
    tf::precision precision = tf::precision::float64;  ///< written
    tf::placement at{};
    std::optional<tf::laid_flat> laid{};
    std::optional<tf::align_result> aligned{};
    std::optional<mating> mated{};
    std::string reason{};       ///< why there is no place, in words
    std::string remedy{};       ///< then, what else may be done: "; separate would ..."
    tf::transform<3> matrix{};  ///< from the file to the place, with --start

    /// A share is of the diagonal of MOVING's box.
    [[nodiscard]] double used(const distance& d) const {
        return d.used(moving.files[0].box->diagonal());
    }
};

/// Finds a place for one input, and writes it.
[[nodiscard]] exit_status place_one(job& work, const place_settings& settings, fixed_meshes& fixed);
/// Puts all inputs beside each other on a plate, and writes that. \returns found when not all fit
[[nodiscard]] exit_status pack_all(job& work, const place_settings& settings);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const place_settings& settings);
void enter_inputs(json& entry, const tf::body_file& moving, const fixed_meshes& fixed);
void enter_place(json& entry, const placing& p);

/// What has become of MOVING: "dropped by 4.5; touching bed.stl (4 contacts)".
[[nodiscard]] std::string sentence(const placing& p);
/// Says that, and what -v adds to it.
void say_place(job& work, const placing& p);

/// Page and picture, where they are asked for: MOVING where it is and was, what it meets, and how
/// far it is from that: `known`, where that was asked for.
void write_page(job& work, const placing& p, const tf::deviation_result* known = nullptr);
/// The page of plates and parts.
void write_page(job& work, const place_settings& settings, const tf::body_set& parts,
                const tf::packing& found);

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
