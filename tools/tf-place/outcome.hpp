#pragma once
/// \file
/// Where MOVING goes, and what that is written to: the report, the matrix, the mesh.

#include "tools/common/written_form.hpp"
#include "tools/tf-place/body.hpp"
#include "tools/tf-place/settings.hpp"
#include <treeform/mesh/align.hpp>
#include <treeform/mesh/lay_flat.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// What the library has found, in one form for all modes.
struct outcome {
    tf::placement at{};
    std::optional<tf::laid_flat> laid{};
    double flatness = 0.0;  ///< of `lay`
    std::optional<tf::align_result> aligned{};
    std::string reason{};  ///< why there is no place, in words

    /// Whether all is as wished: of `fit`, that it converged.
    [[nodiscard]] bool complete() const { return at && (!aligned || aligned->converged); }
};

/// \throws failure (bad_usage) where the height is none that can be written
void check_bed(double level, tf::precision precision);

/// Finds the place of the one body of `moving`.
[[nodiscard]] outcome place(job& work, const body_set& moving, const body_set& fixed,
                            const place_settings& settings, tf::precision precision);

/// With what numbers the mesh made of `file` will be written.
[[nodiscard]] tf::precision precision_of(const job& work, const tf::mesh_file& file);

/// "dropped by 4.5; touching bed.stl (4 contacts)"
[[nodiscard]] std::string verdict(const body& moving, const outcome& found, const body_set& fixed,
                                  const place_settings& settings);

/// What -v adds.
void say_details(job& work, const outcome& found, const body_set& fixed);

/// "closer-than-clearance", as in reports.
[[nodiscard]] const char* name_of(tf::standing standing);
/// A matrix, as in reports.
[[nodiscard]] json rows_of(const tf::transform<3>& matrix);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const place_settings& settings);
void enter_bodies(job& work, const body& moving, const body_set& fixed);
void enter_report(job& work, const body& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& matrix);

/// To --matrix, where it is given.
void write_matrix(const job& work, const place_settings& settings, const std::string& text);

/// MOVING at its place, with --scene the fixed meshes too, with the faces colored by what they
/// meet where the format has colors. All that moves was moved by `all_moves`.
void write_result(job& work, body_set& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& all_moves);

/// All MOVING put beside each other on a plate: reads all inputs, arranges and writes them.
/// \returns found when not all fit
[[nodiscard]] exit_status arrange_all(job& work, const place_settings& settings);

/// A body that goes somewhere, and by what it was moved in all: normals turn as that.
struct placed_body {
    std::size_t number = 0;
    tf::points_view points{};
    tf::transform<3> matrix{};
    tf::transform<3> all_moves{};
};

/// Puts bodies at their places in their files.
void put_back(body_set& moving, std::span<const placed_body> placed, tf::precision precision);

/// Enters what their points have lost, and says what is noticeable.
void enter_rounding(job& work, const body_set& moving, std::span<const placed_body> placed,
                    tf::precision precision);

/// The files of `bodies`, each once, as a scene.
[[nodiscard]] tf::mesh_file scene_of(job& work, std::span<const body* const> bodies,
                                     const std::string& format);

/// Writes `file` and says so in the report.
void write(job& work, const tf::mesh_file& file, const written_form& form,
           const std::filesystem::path& path, tf::precision precision, bool scene);

}  // namespace tools
