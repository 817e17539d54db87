#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

/// The cube [0, 2]^3 as an STL has it: three vertices of its own for every face.
tf::mesh unjoined_cube() {
    const tf::mesh cube = test::box(2, 2, 2);
    tf::mesh soup;
    for (const tf::face& f : cube.faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : f) soup.points.push_back(cube.points[corner]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

}  // namespace

TEST_CASE(
    "prepared queries: a second question builds nothing, and the answer is that of the view") {
    const tf::mesh cube = unjoined_cube();
    const tf::mesh other = test::moved(cube, {5, 0, 0});
    const auto a = tf::prepared_mesh::borrow(cube), b = tf::prepared_mesh::borrow(other);
    const std::vector<tf::point3> points{{1, 1, 1}, {3, 1, 1}, {2, 1, 1}};
    const std::vector<tf::ray3> rays{{{-1, 0.5, 0.25}, {1, 0, 0}}, {{-1, 9, 9}, {1, 0, 0}}};
    const std::vector<std::function<bool()>> questions{
        [&] { return tf::distance(a, b) == 3.0 && tf::distance(cube, other) == 3.0; },
        [&] { return tf::closest_pair(a, b) == tf::closest_pair(cube, other); },
        [&] { return tf::closest_point(a, points[1]) == tf::closest_point(cube, points[1]); },
        [&] { return tf::closest_point(a, points) == tf::closest_point(cube, points); },
        [&] { return tf::locate(a, points) == tf::locate(cube, points); },
        [&] { return tf::contains(a, points[0]) && tf::contains(cube, points[2]); },
        [&] { return !tf::contains(a, points[1]) && !tf::contains(cube, points[1]); },
        [&] { return tf::winding_number(a, points[0]) == 1; },
        [&] { return tf::raycast(a, rays) == tf::raycast(cube, rays); },
        [&] { return tf::raycast(a, rays[0])->t == 1.0 && !tf::raycast(cube, rays[1]); },
        [&] {
            const auto all = tf::raycast_all(cube, rays);
            for (std::size_t r = 0; r < all.size(); ++r) {
                const std::vector<tf::mesh_hit> hits = tf::raycast_all(a, rays[r]);
                if (!std::ranges::equal(hits, all[r])) return false;
                if (tf::raycast_any(a, rays[r]) == hits.empty()) return false;
            }
            return tf::raycast_any(a, rays) == std::vector<std::uint8_t>{1, 0};
        },
        [&] { return tf::raycast_all(a, rays).begin == tf::raycast_all(cube, rays).begin; },
        [&] { return !tf::intersects(a, b) && !tf::intersects(cube, other); },
        [&] { return tf::intersects(a, a) && tf::intersects(cube, cube); },
        [&] { return tf::mesh_intersections(a, b).pairs.empty(); },
        [&] { return tf::self_intersections(a).pairs.empty(); },
    };
    for (const auto& question : questions) CHECK(question());
    const std::uint64_t built = a.indexes_built() + b.indexes_built();
    CHECK(built > 0);
    for (const auto& question : questions) CHECK(question());
    CHECK(a.indexes_built() + b.indexes_built() == built);
}

TEST_CASE("prepared queries: a mesh that moves keeps what was built of it") {
    const tf::prepared_mesh a(test::box(2, 2, 2)), b(test::box(1, 1, 1));
    CHECK(tf::intersects(a, b));
    const auto away = tf::transform<3>::translation(tf::point3{0, 0, 4});
    CHECK_FALSE(tf::intersects(a, b, {.transform_b = away}));
    CHECK(tf::distance(a, b, {.transform_b = away}) == 2.0);
    CHECK(tf::distance(a, b, {.transform_b = away, .radius = 1.0}) ==
          std::numeric_limits<double>::infinity());
    const tf::mesh_pair_options moved{.transform_a = away, .transform_b = away};
    CHECK(tf::intersects(a.indexed_view(), b.indexed_view(), moved));
}

TEST_CASE("prepared queries: errors name the verb, the mesh and its face or point") {
    tf::mesh bad = test::box(1, 1, 1);
    bad.points[bad.faces[0][1]].y = std::numeric_limits<double>::quiet_NaN();
    const tf::mesh good = test::box(1, 1, 1);
    tf::mesh wild = good;
    wild.faces[4][2] = 99;
    CHECK_THROWS_WITH_AS((void)tf::intersects(good, bad),
                         "treeform::intersects: b: face 0 has a corner that is not "
                         "finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)tf::intersects(wild, good),
        doctest::Contains("treeform::intersects: a: face 4 has a corner out of range"),
        std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)tf::closest_point(wild, tf::point3{}),
        doctest::Contains("treeform::closest_point: face 4 has a corner out of range"),
        std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::raycast(bad, tf::ray3{{0, 0, 0}, {1, 0, 0}}),
                         "treeform::raycast: face 0 has a corner that is not finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::locate(wild, tf::point3{}),
                         doctest::Contains("treeform::locate: face 4 has a corner out of range"),
                         std::invalid_argument);
}
