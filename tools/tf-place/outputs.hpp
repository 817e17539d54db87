#pragma once
/// \file
/// What a placement is written to: the report, the matrix, the mesh.

#include "tools/tf-place/move.hpp"
#include <treeform/mesh/placement.hpp>
#include <treeform/tf.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// With what numbers the mesh made of `file` will be written.
[[nodiscard]] tf::precision precision_of(const job& work, const tf::mesh_file& file);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const place_settings& settings);
void enter_bodies(job& work, const body& moving, const body_set& fixed);
void enter_report(job& work, const body& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& matrix);
/// A matrix, as in reports.
[[nodiscard]] json rows_of(const tf::transform<3>& matrix);

/// To --matrix, where it is given.
void write_matrix(const job& work, const place_settings& settings, const std::string& text);

/// What the points of body `i`, moved by `matrix`, have lost.
[[nodiscard]] tf::rounding_effects look_at_rounding(job& work, const body_set& moving,
                                                    std::size_t i, const tf::transform<3>& matrix,
                                                    tf::points_view placed,
                                                    tf::precision precision);
/// Enters them, as one, in the report, and says what is noticeable or harmful.
void enter_rounding(job& work, std::span<const tf::rounding_effects> all, tf::precision precision);

/// Puts body `i` at its place in its file; normals turn as `all_moves` does.
void put_back(body_set& moving, std::size_t i, tf::points_view placed,
              const tf::transform<3>& matrix, const tf::transform<3>& all_moves,
              tf::precision precision);

/// MOVING at its place, with --scene the fixed meshes too, with the faces colored by what they
/// meet where the format has colors.
void write_result(job& work, body_set& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& all_moves);

/// The parts that were placed, together in one file.
void write_plate(job& work, const body_set& parts, const std::vector<bool>& placed,
                 tf::precision precision);

/// All MOVING put beside each other on a plate: reads all inputs, arranges and writes them.
/// \returns found when not all fit
[[nodiscard]] exit_status arrange_all(job& work, const place_settings& settings);

}  // namespace tools
