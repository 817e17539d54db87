#pragma once
/// \file
/// The lines along which faces meet, as a file to be drawn.

#include "tools/common/run.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// \throws failure (bad_usage) for a path that is neither "-", of an obj nor of a ply
void check_curve_path(const std::filesystem::path& path);

/// Whole numbers of each pair, for the segments of a PLY.
struct pair_numbers {
    std::string name;
    std::vector<std::uint32_t> of_pair;  ///< [pairs]
};

/// Paths whose points are named by what meets there, rounded; for faces without area, which have
/// none, segments of their own. Nothing where no `path` is named, and in a dry run.
void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs, const std::vector<pair_numbers>& numbers);

}  // namespace tools
