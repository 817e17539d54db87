/// \file
/// Pairs of real files against what an exact kernel found of them: the distances and meeting faces
/// of TRUTH_PAIRS.csv, where the moved points are those that doubles give. Without
/// TREEFORM_MODELS_DIR nothing is checked.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/intersect/mesh_intersections.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <doctest/doctest.h>
#include <support/models.hpp>
#include <support/truth.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace {

tf::mesh read_joined(const std::filesystem::path& path, const tf::transform<3>& by) {
    tf::mesh mesh = tf::join_equal_points(tf::read(path).mesh);
    for (tf::point3& p : mesh.points) p = by(p);
    return mesh;
}

double largest_coordinate(const tf::mesh& mesh) {
    double largest = 0.0;
    for (const tf::point3& p : mesh.points)
        for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
    return largest;
}

tf::triangle3 triangle_of(const tf::mesh& mesh, std::size_t f) {
    const tf::face& corners = mesh.faces[f];
    return {mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]};
}

double between(const tf::point3& p, const tf::point3& q) {
    return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
}

}  // namespace

TEST_CASE("truth: every distance of every pair of files is that of the exact kernel") {
    NEEDS_MODELS();
    const std::filesystem::path folder = test::models_folder();
    int rows = 0, apart = 0, exactly = 0;
    for (const test::truth_row& row : test::read_truth(folder / "TRUTH_PAIRS.csv")) {
        if (row.text("transform") == "exact") continue;  // of points that are no doubles
        CAPTURE(row.text("pair"));
        const tf::mesh a = read_joined(folder / row.text("file_a"), row.map("matrix_a"));
        const tf::mesh b = read_joined(folder / row.text("file_b"), row.map("matrix_b"));
        const tf::tree<3> tree_a = tf::build_face_tree(a), tree_b = tf::build_face_tree(b);
        const auto found = tf::measure(a, b);
        REQUIRE(found.has_value());

        const double truth = row.real("min_distance");
        const double scale = std::max(largest_coordinate(a), largest_coordinate(b));
        CHECK((found->surface_distance == 0.0) == (truth == 0.0));
        CHECK(std::abs(found->surface_distance - truth) <= 0x1p-47 * scale);
        exactly += found->surface_distance == truth;
        CHECK(std::abs(between(found->on_a.point, found->on_b.point) - truth) <= 0x1p-47 * scale);
        // The pair that the exact kernel names is no nearer.
        const auto named =
            tf::closest_pair(triangle_of(a, static_cast<std::size_t>(row.number("closest_tri_a"))),
                             triangle_of(b, static_cast<std::size_t>(row.number("closest_tri_b"))));
        CHECK(std::sqrt(named.squared_distance) >= found->surface_distance - 0x1p-47 * scale);

        if (row.number("degenerate_a") == 0 && row.number("degenerate_b") == 0) {
            std::uint64_t pairs = 0;
            for (const std::uint64_t n :
                 tf::detail::intersect::mesh_intersections(a, tree_a, b, tree_b).counts)
                pairs += n;
            CHECK(static_cast<std::int64_t>(pairs) == row.number("intersecting_pairs"));
        }
        // Where the booleans of the two solids are known, so is whether they penetrate.
        if (!row.text("volume_intersection").empty() &&
            row.text("volume_intersection") != "nonmanifold") {
            const bool inner = row.real("volume_intersection") > 0.0;
            CHECK((found->relation == tf::mesh_relation::penetrating) == inner);
        }
        ++rows;
        apart += truth > 0.0;
    }
    CHECK(rows > 0);
    MESSAGE(rows << " pairs checked, " << apart << " of them apart, " << exactly
                 << " distances equal bit for bit");
}
