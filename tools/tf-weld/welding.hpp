#pragma once
/// \file
/// From a file to what becomes of its points and faces.

#include "tools/shell/run.hpp"
#include "tools/tf-weld/settings.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace tools {

struct welding {
    std::uint64_t points = 0;     ///< in the input
    std::uint64_t polygons = 0;   ///< faces as stored
    std::uint64_t triangles = 0;  ///< these cut into triangles; what is welded
    std::optional<tf::box3> box{};
    double tolerance = 0.0;
    std::vector<tf::weld_condition> conditions{};
    tf::file_weld_result result{};

    /// What is kept of what was welded on the disk, and is not in `result`.
    struct kept {
        std::uint64_t points;
        std::uint64_t triangles;
    };
    std::optional<kept> counted{};

    [[nodiscard]] std::uint64_t distinct() const {
        return counted ? counted->points : result.vertex_source.size();
    }
    [[nodiscard]] std::uint64_t triangles_kept() const {
        return counted ? counted->triangles : result.file.mesh.faces.size();
    }
    [[nodiscard]] std::uint64_t removed() const { return points - distinct(); }
    [[nodiscard]] bool keeps(std::uint32_t point) const {
        return result.vertex_source[result.groups.group_of_point[point]] == point;
    }
};

/// Welds `file`.
/// \throws failure (bad_input) when there are no points, or a property is not there; (stopped)
[[nodiscard]] welding weld(job& work, const tf::mesh_file& file, const weld_settings& settings);

/// `tf::count_mergeable` for what `result` is about.
[[nodiscard]] std::optional<std::uint64_t> mergeable(job& work, const tf::mesh_file& welded,
                                                     const welding& result,
                                                     const weld_settings& settings,
                                                     tf::precision written_as);

}  // namespace tools
