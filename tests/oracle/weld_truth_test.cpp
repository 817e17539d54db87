/// \file
/// Groups of the points of real files against those that an exact kernel found: the columns of
/// TRUTH.csv about welding. Without TREEFORM_MODELS_DIR nothing is checked.

#include <libmesh/base/nearest_float.hpp>
#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/truth.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace {

struct tolerance_column {
    const char* groups;
    const char* tolerance;  ///< null: 0
};
constexpr std::array columns{
    tolerance_column{"weld_eps0", nullptr}, tolerance_column{"weld_1e-6", "eps_1e-6"},
    tolerance_column{"weld_1e-4", "eps_1e-4"}, tolerance_column{"weld_1e-3", "eps_1e-3"}};

std::vector<tf::point3> finite_points(const std::vector<tf::point3>& stored, bool as_float) {
    using tf::detail::base::nearest_float;
    std::vector<tf::point3> points;
    for (tf::point3 p : stored) {
        if (as_float) p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.push_back(p);
    }
    return points;
}

/// Distinct points of the largest group.
std::int64_t largest_group(const std::vector<tf::point3>& points, const tf::point_groups& groups) {
    const tf::point_groups equal = tf::group_points(points, {});
    std::vector<std::int64_t> size(groups.first_of_group.size(), 0);
    for (const std::uint32_t first : equal.first_of_group) ++size[groups.group_of_point[first]];
    return size.empty() ? 0 : *std::max_element(size.begin(), size.end());
}

}  // namespace

TEST_CASE("truth: chains are as many as an exact kernel found, by every search") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    int figures = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH.csv")) {
        if (row.text("status") != "ok") continue;
        CAPTURE(row.text("file"));
        CAPTURE(row.text("precision"));
        const tf::mesh_file file = tf::read(folder / row.text("file"));
        const std::vector<tf::point3> points =
            finite_points(file.mesh.points, row.text("precision") == "f32");
        for (const tolerance_column& column : columns)
            for (const tf::detail::weld::neighbor_search search :
                 {tf::detail::weld::neighbor_search::automatic,
                  tf::detail::weld::neighbor_search::window,
                  tf::detail::weld::neighbor_search::cells,
                  tf::detail::weld::neighbor_search::tree}) {
                CAPTURE(column.groups);
                CAPTURE(static_cast<int>(search));
                const double tolerance =
                    column.tolerance == nullptr ? 0.0 : row.real(column.tolerance);
                const tf::point_groups groups = tf::detail::weld::find_groups(
                    "group_points", points, {.tolerance = tolerance, .chain = true}, search);
                CHECK(static_cast<std::int64_t>(groups.first_of_group.size()) ==
                      row.number(column.groups));
                if (std::string(column.groups) == "weld_1e-3")
                    CHECK(largest_group(points, groups) == row.number("largest_cluster_1e-3"));
                ++figures;
            }
    }
    CHECK(figures > 0);
    MESSAGE(figures << " figures checked");
}
