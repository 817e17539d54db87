#pragma once
/// \file
/// What a placement is written to: the report, the matrix, the mesh.

#include "tools/tf-place/move.hpp"
#include <treeform/tf.hpp>

#include <filesystem>

namespace tools {

/// Looks at the outputs before the work, so that it is not lost in the end. \throws failure
void check_outputs(const job& work, const place_settings& settings);

/// Whether the mesh made of `file` will be written as float32.
[[nodiscard]] bool writes_single(const job& work, const tf::mesh_file& file);

/// The keys of a report's file, each with nothing in it.
void enter_blank_report(job& work, const place_settings& settings);
void enter_bodies(job& work, const body& moving, const surroundings& among);
void enter_report(job& work, const body& moving, const placement& p, const surroundings& among,
                  const tf::transform<3>& matrix);

void write_matrix(const job& work, const std::filesystem::path& path,
                  const tf::transform<3>& matrix);

/// MOVING at its place, with --scene the fixed meshes too, with the faces coloured by what they
/// meet where the format has colours. Normals turn as `all_moves` does.
void write_result(job& work, body& moving, const placement& p, const surroundings& among,
                  const place_settings& settings, const tf::transform<3>& all_moves,
                  bool to_single);

/// The parts that were placed, together in one file.
void write_plate(job& work, const std::vector<body>& bodies, const std::vector<bool>& placed,
                 bool to_single);

}  // namespace tools
