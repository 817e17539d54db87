#pragma once
/// \file
/// From a file to what becomes of its points and faces.

#include "tools/common/run.hpp"
#include "tools/tf-weld/settings.hpp"
#include <treeform/mesh/bounding_box.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace tools {

struct welding {
    std::uint64_t points = 0;      ///< in the input
    std::uint64_t polygons = 0;    ///< faces as stored
    std::uint64_t triangles = 0;   ///< these cut into triangles; what is welded
    std::uint64_t non_finite = 0;  ///< points
    std::optional<tf::box3> box{};
    double tolerance = 0.0;
    std::vector<tf::weld_condition> conditions{};
    std::vector<std::uint32_t> polygon_of_triangle{};  ///< empty: each face is one triangle
    tf::mesh_weld_result result{};                     ///< of the input's points

    /// Of a cloud that was welded out of memory, and has no groups in `result`.
    struct counts {
        std::uint64_t distinct = 0;
        std::uint64_t groups = 0;
    };
    std::optional<counts> counted{};

    [[nodiscard]] std::uint64_t distinct() const {
        return counted ? counted->distinct : result.point_of_group.size();
    }
    [[nodiscard]] std::uint64_t removed() const { return points - distinct(); }
    /// Groups of two points or more.
    [[nodiscard]] std::uint64_t groups() const;
    [[nodiscard]] bool keeps(std::uint32_t point) const {
        return result.point_of_group[result.groups.group_of_point[point]] == point;
    }
};

/// Welds `file`, whose polygons are cut into triangles for it.
/// \throws failure (bad_input) when there are no points, or a property is not there; (stopped)
[[nodiscard]] welding weld(job& work, tf::mesh_file& file, const weld_settings& settings);

/// How many points of a file to be written would merge if it were welded again: those that rounding
/// to `written_as`, or the choice of what is kept, has brought together. None where points within
/// the tolerance are left apart on purpose, by --borders or --keep-manifold.
[[nodiscard]] std::optional<std::uint64_t> still_within(job& work, const tf::mesh_file& welded,
                                                        const welding& result,
                                                        const weld_settings& settings,
                                                        tf::precision written_as);

}  // namespace tools
