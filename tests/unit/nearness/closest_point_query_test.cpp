#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/extremes.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

using test::infinity;
using test::triangle_of;

std::optional<tf::closest_point_result> closest_by_brute_force(const tf::mesh& mesh,
                                                               const tf::point3& query) {
    std::optional<tf::closest_point_result> best;
    double squared = infinity;
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        const auto closest = tf::closest_point(triangle_of(mesh, i), query);
        if (best && !(closest.squared_distance < squared)) continue;
        squared = closest.squared_distance;
        best = {i, std::sqrt(squared), closest.point};
    }
    return best;
}

std::vector<tf::point3> queries_around(test::random& source, std::size_t count, double reach) {
    std::vector<tf::point3> queries(count);
    for (tf::point3& p : queries)
        p = {source.in(-reach, reach), source.in(-reach, reach), source.in(-reach, reach)};
    return queries;
}

std::vector<std::pair<std::string, tf::mesh>> meshes() {
    test::random source(3);
    std::vector<std::pair<std::string, tf::mesh>> all;
    all.emplace_back("soup", test::random_soup(source, 700, 0.1));
    all.emplace_back("lattice", test::lattice_soup(source, 500, 200, 5));
    all.emplace_back("fan", test::fan(source, 100));
    all.emplace_back("grid", test::grid(12));
    all.emplace_back("one", test::random_soup(source, 1, 0.5));
    all.emplace_back("far off", test::moved(test::grid(8), {1e7, 0, 0}));
    tf::mesh same = test::grid(1);
    same.faces.resize(50, same.faces[0]);
    all.emplace_back("equal", same);
    return all;
}

}  // namespace

TEST_CASE("closest point query: a mesh without faces has no nearest point") {
    const tf::detail::nearness::closest_point_query none;
    CHECK(!none.nearest({1, 2, 3}));
    const tf::detail::nearness::closest_point_query empty{tf::mesh{}};
    CHECK(!empty.nearest({1, 2, 3}));
    const std::vector<tf::point3> queries(3);
    for (const auto& one : empty.nearest(queries)) CHECK(!one);
}

TEST_CASE("closest point query: the radius is inclusive") {
    const tf::detail::nearness::closest_point_query query(test::grid(3));
    CHECK(query.nearest({1.25, 1.5, 2}, 2.0)->distance == 2.0);
    CHECK(!query.nearest({1.25, 1.5, 2}, std::nextafter(2.0, 0.0)));
    CHECK(query.nearest({1.25, 1.5, 0}, 0.0)->point == tf::point3{1.25, 1.5, 0});
}

TEST_CASE("closest point query: the answer is that of a loop over all faces, to the last bit") {
    test::random source(4);
    for (const auto& named : meshes()) {
        CAPTURE(named.first);
        const tf::mesh& mesh = named.second;
        const tf::detail::nearness::closest_point_query query(mesh);
        std::vector<tf::point3> queries = queries_around(source, 300, 8.0);
        for (const tf::point3& p : queries_around(source, 300, 1.0)) queries.push_back(p);
        for (const tf::point3& p : mesh.points) queries.push_back(p);
        for (std::size_t i = 0; i < 600; i += 3) queries[i].x += mesh.points[0].x;
        queries.push_back({1e12, -1e11, 0});
        const auto batch = query.nearest(queries);
        REQUIRE(batch.size() == queries.size());
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const auto expected = closest_by_brute_force(mesh, queries[i]);
            REQUIRE(query.nearest(queries[i]) == expected);
            REQUIRE(batch[i] == expected);
        }
    }
}

TEST_CASE("closest point query: a power of two changes nothing but the scale") {
    test::random source(5);
    const tf::mesh mesh = test::random_soup(source, 200, 0.2);
    const tf::detail::nearness::closest_point_query query(mesh);
    for (const double factor : {0x1p-900, 0x1p-300, 0x1p+300, 0x1p+1000}) {
        CAPTURE(factor);
        const tf::detail::nearness::closest_point_query scaled(test::scaled(mesh, factor));
        for (const tf::point3& p : queries_around(source, 30, 2.0)) {
            const auto expected = query.nearest(p);
            const auto found = scaled.nearest({p.x * factor, p.y * factor, p.z * factor});
            REQUIRE(found->face == expected->face);
            REQUIRE(found->distance == expected->distance * factor);
        }
    }
}

TEST_CASE("closest point query: from the ends of the range of double the distance is finite") {
    const tf::detail::nearness::closest_point_query query(test::grid(2));
    CHECK(query.nearest({1e300, 0, 0})->distance == 1e300);
    CHECK(query.nearest({0, 1e-300, -1e-300})->distance <= 1e-150);
    CHECK(!query.nearest({1e300, 0, 0}, 1e299));
}

TEST_CASE("closest point query: answers are the same on any number of threads") {
    test::random source(6);
    const tf::mesh mesh = test::random_soup(source, 3000, 0.05);
    const std::vector<tf::point3> queries = queries_around(source, 2000, 1.0);
    const auto expected = tf::detail::nearness::closest_point_query(mesh).nearest(queries);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::detail::nearness::closest_point_query(mesh).nearest(queries) == expected);
    }
}

TEST_CASE("closest point query: what cannot be meant is refused by name") {
    tf::mesh mesh = test::grid(2);
    const tf::detail::nearness::closest_point_query query(mesh);
    const std::vector<tf::point3> queries{{0, 0, 0}, {0, infinity, 0}};
    CHECK_THROWS_WITH_AS((void)query.nearest(queries),
                         "treeform::closest_point: point 1 is not finite", std::invalid_argument);
    CHECK_THROWS_AS((void)query.nearest(queries[1]), std::invalid_argument);
    CHECK_THROWS_AS((void)query.nearest(queries[0], -1.0), std::invalid_argument);
    mesh.points[3].y = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(tf::detail::nearness::closest_point_query{mesh}, std::invalid_argument);
    mesh = test::grid(2);
    mesh.faces[5][1] = 99;
    CHECK_THROWS_WITH_AS(
        tf::detail::nearness::closest_point_query{mesh},
        doctest::Contains("treeform::closest_point: face 5 has a corner out of range"),
        std::invalid_argument);
}
