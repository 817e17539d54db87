#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/nearness/bounding_cylinders.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/soups.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

/// A sheet of waves: flat at the size of leaves, round at that of the root.
tf::mesh waves(std::uint32_t side, double height) {
    tf::mesh sheet = test::grid(side);
    for (tf::point3& p : sheet.points) p.z = height * std::sin(0.3 * p.x) * std::cos(0.2 * p.y);
    return sheet;
}

tf::transform<3> turned(test::random& source, double scale, double away) {
    double w = source.in(-1, 1), x = source.in(-1, 1), y = source.in(-1, 1), z = source.in(-1, 1);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    w /= length, x /= length, y /= length, z /= length;
    tf::transform<3> pose;
    pose.rows[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0};
    pose.rows[1] = {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0};
    pose.rows[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0};
    for (auto& row : pose.rows) {
        for (double& entry : row) entry *= scale;
        row[3] = source.in(-away, away);
    }
    return pose;
}

/// The answer of the models must be that of the meshes and their trees.
void compare(const tf::mesh& a, const tf::mesh& b, const tf::transform<3>& transform_a,
             const tf::transform<3>& transform_b) {
    const auto found = tf::closest_pair(tf::prepared_mesh::borrow(a), tf::prepared_mesh::borrow(b),
                                        {transform_a, transform_b});
    const auto expected = tf::detail::nearness::closest_pair(
        a, tf::transformed<3>(tf::build_face_tree(a), transform_a), b,
        tf::transformed<3>(tf::build_face_tree(b), transform_b));
    REQUIRE(found);
    REQUIRE(expected);
    if (expected->distance > 0.0)
        CHECK(*found == *expected);
    else
        CHECK(found->distance == 0.0);
}

}  // namespace

TEST_CASE("prepared distance: one without faces is near to nothing") {
    const tf::prepared_mesh none;
    const tf::prepared_mesh one(test::grid(1));
    CHECK(none.indexed_view().faces.empty());
    CHECK(!tf::closest_pair(none, one));
    CHECK(!tf::closest_pair(one, none));
    CHECK(!tf::closest_pair(none, tf::prepared_mesh(tf::mesh{})));
    const auto away = tf::closest_pair(
        one, one, {.transform_b = tf::transform<3>::translation(tf::point3{0, 0, 2})});
    REQUIRE(away);
    CHECK(away->distance == 2.0);
}

TEST_CASE("prepared distance: the radius is inclusive, and what cannot be meant is refused") {
    const tf::prepared_mesh one(test::grid(1));
    const auto above = tf::transform<3>::translation(tf::point3{0, 0, 2});
    CHECK(tf::closest_pair(one, one, {.transform_b = above, .radius = 2.0}));
    CHECK(!tf::closest_pair(one, one, {.transform_b = above, .radius = std::nextafter(2.0, 0.0)}));
    CHECK_THROWS_AS((void)tf::closest_pair(one, one, {.radius = -1.0}), std::invalid_argument);
    tf::transform<3> bad;
    bad.rows[1][2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::closest_pair(one, one, {.transform_a = bad}), std::invalid_argument);
    tf::mesh broken = test::grid(2);
    broken.points[1].y = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS((void)tf::closest_pair(one, tf::prepared_mesh::borrow(broken)),
                         doctest::Contains("closest_pair: b: face"), std::invalid_argument);
    broken = test::grid(2);
    broken.faces[1][2] = 77;
    CHECK_THROWS_WITH_AS((void)tf::closest_pair(one, tf::prepared_mesh::borrow(broken)),
                         doctest::Contains("closest_pair: b: face"), std::invalid_argument);
}

TEST_CASE("bounding cylinders: those of every node hold the triangles below it") {
    test::random source(1);
    for (const tf::mesh& mesh :
         {waves(45, 2.0), test::random_soup(source, 700, 0.1), test::grid(23),
          test::scaled(waves(20, 1.0), 0x1p-700), test::lattice_soup(source, 600, 90, 5),
          test::moved(waves(30, 1e-6), {1e6, -1e6, 3})}) {
        const tf::tree<3> tree = tf::build_face_tree(mesh);
        const auto triangles = tf::detail::nearness::triangle_blocks(mesh, tree);
        const tf::detail::nearness::bounding_cylinders cylinders(tree, triangles);
        const tf::tree_frame<3>& frame = tree.frame();
        bool all_inside = true;
        for (unsigned level = 0; level + 1 < tree.levels(); ++level)
            for (std::size_t place = 0; place < tree.size(); ++place) {
                const std::size_t child = place / tree.capacity(level + 1);
                const auto& eight = cylinders.below(level, static_cast<std::uint32_t>(child / 8));
                const std::size_t slot = child % 8;
                double normal[3], length = 0.0;
                for (std::size_t k = 0; k < 3; ++k) {
                    normal[k] = eight.normal[k][slot];
                    length += normal[k] * normal[k];
                }
                for (double& part : normal) part /= std::sqrt(length);
                all_inside &= std::abs(std::sqrt(length) - 1.0) < 0x1p-22;
                for (const tf::point3& p : triangles[place / 8].triangle(place % 8)) {
                    double along = 0.0, square = 0.0, q[3];
                    for (std::size_t k = 0; k < 3; ++k) {
                        q[k] = (p[k] - frame.origin[k]) * frame.scale -
                               static_cast<double>(eight.center[k][slot]);
                        along += q[k] * normal[k];
                    }
                    for (std::size_t k = 0; k < 3; ++k)
                        square += (q[k] - along * normal[k]) * (q[k] - along * normal[k]);
                    all_inside &= std::abs(along) <= static_cast<double>(eight.half[slot]);
                    all_inside &= std::sqrt(square) <= static_cast<double>(eight.radius[slot]);
                }
            }
        CHECK(all_inside);
    }
}

TEST_CASE("prepared distance: the answer is that of the meshes with their trees") {
    test::random source(2);
    const std::vector<tf::mesh> meshes{waves(24, 2.0),  test::random_soup(source, 400, 0.1),
                                       test::grid(9),   test::lattice_soup(source, 300, 80, 6),
                                       waves(33, 0.01), test::random_soup(source, 1, 0.1)};
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (std::size_t j = 0; j < meshes.size(); ++j) {
            CAPTURE(i);
            CAPTURE(j);
            const double away = i % 2 == 0 ? 60.0 : 8.0;
            compare(meshes[i], meshes[j], {}, turned(source, 1.0, away));
            compare(meshes[i], meshes[j], turned(source, 1.0, away), turned(source, 0.25, away));
        }
}

TEST_CASE("prepared distance: a map may stretch, shear, flatten or mirror") {
    test::random source(3);
    const tf::mesh a = waves(20, 2.0);
    const tf::mesh b = waves(26, 1.0);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        tf::transform<3> map = turned(source, 1.0, 40.0);
        for (std::size_t k = 0; k < 3; ++k) {
            map.rows[k][0] *= source.in(-3.0, 3.0);
            if (round % 3 == 0) map.rows[k][1] = 0.0;
            if (round % 3 == 1) map.rows[k][2] += source.in(-2.0, 2.0);
        }
        compare(a, b, {}, map);
        compare(a, b, map, turned(source, 1.0, 40.0));
    }
}

TEST_CASE("prepared distance: meshes of any size and far from each other are measured") {
    test::random source(4);
    const tf::mesh a = waves(20, 2.0);
    for (const double factor : {0x1p-900, 0x1p-300, 1e-6, 1e6, 0x1p300, 0x1p900}) {
        CAPTURE(factor);
        const tf::mesh scaled = test::scaled(a, factor);
        compare(scaled, scaled, {},
                tf::transform<3>::translation(tf::point3{factor, 2 * factor, 9 * factor}));
        if (0x1p-400 < factor && factor < 0x1p400) {
            compare(scaled, a, {}, turned(source, 1.0, 50.0));
            compare(a, a, {}, turned(source, factor, 50.0 * factor));
        }
    }
    compare(a, a, {}, tf::transform<3>::translation(tf::point3{1e9, 0, 0}));
    tf::mesh stray = waves(5, 2.0);  // one corner where the frame of the tree has no room for it
    stray.points[0] = {1e30, 0, 0};
    compare(stray, a, {}, tf::transform<3>::translation(tf::point3{0, 0, 9}));
    stray.points[0] = {-1.7e308, 1.7e308, 0};
    compare(stray, a, {}, tf::transform<3>::translation(tf::point3{0, 0, 9}));
}

TEST_CASE("prepared distance: many equally near faces give one answer on any number of threads") {
    const tf::mesh flat = test::grid(60);
    const tf::prepared_mesh one = tf::prepared_mesh::borrow(flat),
                            other(test::moved(flat, {0.25, 0.5, 3}));
    const auto expected = tf::closest_pair(one, other);
    CHECK(expected->distance == 3.0);
    CHECK(expected->face_a == 0);
    const auto meeting = tf::closest_pair(one, one);
    CHECK(meeting->distance == 0.0);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::closest_pair(one, other) == expected);
        CHECK(tf::closest_pair(one, one) == meeting);
        const tf::prepared_mesh again = tf::prepared_mesh::borrow(flat);
        CHECK(tf::closest_pair(again, other) == expected);
    }
}
