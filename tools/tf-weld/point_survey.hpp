#pragma once
/// \file
/// What is to be known of a cloud before it is cut into tiles.

#include "tools/common/run.hpp"
#include <treeform/mesh/bounding_box.hpp>
#include <treeform/mesh/point_stream.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tools {

struct point_survey {
    std::uint64_t points = 0;
    std::uint64_t non_finite = 0;
    std::optional<tf::box3> box{};
    bool single = true;  ///< float32 holds every coordinate
    std::string format{};
    std::vector<tf::io_warning> warnings{};
    std::vector<tf::point3> sample{};  ///< finite points, all different
    double sample_share = 1.0;         ///< of all points
};

/// Points read at a time.
inline constexpr std::size_t points_a_block = std::size_t{1} << 15;

/// Reads the cloud once, in memory that does not depend on its size. \throws failure, io_error
[[nodiscard]] point_survey survey(job& work, const std::filesystem::path& path);

[[nodiscard]] json to_json(const point_survey& s);
/// The sample is not among it.
[[nodiscard]] point_survey survey_from(const json& stored);

}  // namespace tools
