/// \file
/// Clouds of points among meshes: related, measured, slid and settled like these.

#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_faces.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/deviation.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::triangle_of;
using tf::mesh_relation;

tf::mesh cloud(std::vector<tf::point3> points) {
    auto faces = tf::detail::base::point_faces(points.size());
    return {std::move(points), std::move(faces)};
}

tf::mesh random_cloud(test::random& source, std::size_t count, double size,
                      const tf::point3& center) {
    std::vector<tf::point3> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back({center.x + source.in(-size, size), center.y + source.in(-size, size),
                          center.z + source.in(-size, size)});
    return cloud(std::move(points));
}

/// By asking each point on its own.
mesh_relation relation_by_points(const tf::mesh& points, const tf::mesh& solid) {
    const tf::tree<3> tree = tf::build_face_tree(solid);
    const tf::detail::intersect::point_locator locator(solid, tree);
    auto how = mesh_relation::disjoint;
    for (const tf::point3& p : points.points) {
        const auto where = locator.locate(p).where;
        if (where == tf::location::inside) return mesh_relation::penetrating;
        if (where == tf::location::boundary) how = mesh_relation::touching;
    }
    return how;
}

}  // namespace

TEST_CASE("clouds: a point outside, on a face, and inside of a box") {
    const tf::mesh solid = box(4, 4, 4);
    const auto at = [&](std::vector<tf::point3> points) {
        const tf::mesh given = cloud(std::move(points));
        const auto found = tf::measure(given, solid);
        const auto swapped = tf::measure(solid, given);
        REQUIRE(found.has_value());
        CHECK(found->relation == swapped->relation);
        CHECK(found->distance == swapped->distance);
        return *found;
    };
    const auto outside = at({{9, 9, 9}, {1, 1, 7}});
    CHECK(outside.relation == mesh_relation::disjoint);
    CHECK(outside.distance == 3.0);
    CHECK(outside.on_a.face == 1);
    CHECK(at({{1, 1, 4}}).relation == mesh_relation::touching);
    CHECK(at({{4, 4, 4}}).relation == mesh_relation::touching);
    CHECK(at({{1, 1, 4}, {1, 1, 3}}).relation == mesh_relation::penetrating);
    CHECK(at({{1, 1, 4}, {1, 1, std::nextafter(4.0, 5.0)}}).relation == mesh_relation::touching);
    const auto inside = at({{1, 1, 3.5}});
    CHECK(inside.relation == mesh_relation::penetrating);
    CHECK(inside.distance == 0.0);
    CHECK(inside.surface_distance == 0.5);
}

TEST_CASE("clouds: the relation is that of the points one by one") {
    test::random source(5);
    int seen[3] = {0, 0, 0};
    for (int round = 0; round < 120; ++round) {
        const tf::mesh solid =
            round % 2 == 0 ? test::ball(2, 1.0) : moved(box(2, 2, 2), {-1, -1, -1});
        tf::mesh given = random_cloud(source, 1 + source.below(20), 0.7,
                                      {source.in(-2.5, 2.5), source.in(-2.5, 2.5), 0.0});
        if (round % 3 == 0)  // on a corner, on an edge, or a double of a point
            given.points[0] = solid.points[source.below(solid.points.size())];
        if (round % 5 == 0 && given.points.size() > 1) given.points[1] = given.points[0];
        const auto expected = relation_by_points(given, solid);
        CHECK(tf::relation(given, solid).relation == expected);
        CHECK(tf::relation(solid, given).relation == expected);
        ++seen[static_cast<std::size_t>(expected)];
    }
    for (const int count : seen) CHECK(count > 5);
}

TEST_CASE("clouds: an open mesh has no inside to be in, clouds have none either") {
    tf::mesh sheet = box(4, 4, 4);
    sheet.faces.resize(4);
    CHECK(tf::relation(cloud({{1, 1, 1}, {3, 2, 2}}), sheet).relation == mesh_relation::disjoint);
    const tf::mesh one = cloud({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 5}});
    CHECK(tf::relation(one, cloud({{0.1, 0.1, 0.1}})).relation == mesh_relation::disjoint);
    CHECK(tf::relation(one, cloud({{0, 1, 0}})).relation == mesh_relation::touching);
}

TEST_CASE("clouds: the distance is the least of that of all points") {
    test::random source(6);
    for (int round = 0; round < 30; ++round) {
        const tf::mesh solid = test::ball(2, 1.0);
        const tf::mesh given = random_cloud(source, 1 + source.below(60), 1.0,
                                            {source.in(-1, 1), 3.0, source.in(-1, 1)});
        const tf::detail::nearness::closest_point_query query{tf::mesh_view(solid)};
        double least = std::numeric_limits<double>::infinity();
        for (const tf::point3& p : given.points)
            least = std::min(least, query.nearest(p)->distance);
        const auto found = tf::measure(given, solid);
        REQUIRE(found.has_value());
        CHECK(found->surface_distance == doctest::Approx(least).epsilon(1e-14));
    }
}

TEST_CASE("clouds: sliding ends at the first exact contact of any point") {
    test::random source(7);
    int met = 0;
    for (int round = 0; round < 40; ++round) {
        const tf::mesh given = random_cloud(source, 1 + source.below(30), 0.5, {0, 0, 3});
        const tf::mesh still = moved(test::random_soup(source, 30, 0.6), {0, 0, -1});
        const tf::point3 motion{source.in(-0.2, 0.2), source.in(-0.2, 0.2), -1.0};
        const auto found = tf::time_of_impact(given, still, motion);
        std::optional<tf::sweep_contact> first;
        for (std::size_t i = 0; i < given.faces.size(); ++i)
            for (std::size_t j = 0; j < still.faces.size(); ++j) {
                const auto one =
                    tf::first_contact(triangle_of(given, i), triangle_of(still, j), motion);
                if (one && (!first || tf::compare(motion, *one, *first) < 0)) first = one;
            }
        REQUIRE((found.outcome == tf::placement_outcome::contact) == first.has_value());
        if (!first) continue;
        ++met;
        CHECK(tf::compare_cut(first->from, motion, first->until, found.time) >= 0);
        CHECK(tf::compare_cut(first->from, motion, first->until,
                              std::nextafter(found.time, 1e300)) < 0);
    }
    CHECK(met > 10);
}

TEST_CASE("clouds: what has been slid or separated penetrates nothing as written") {
    test::random source(8);
    for (int round = 0; round < 10; ++round) {
        const tf::mesh solid = test::ball(2, 1.0);
        const auto fixed = tf::prepared_mesh::borrow(solid);
        const tf::mesh above = random_cloud(source, 40, 0.4, {0.2, 0.1, 3.0});
        const auto time = tf::time_of_impact(above, solid, {0.1, 0, -1}).time;
        for (const auto precision : {tf::precision::float64, tf::precision::float32}) {
            const auto moving = tf::prepared_mesh::borrow({above.points});
            CHECK(moving.is_cloud());
            const auto slid = tf::slide(moving, fixed, {0.1, 0, -1}, {.precision = precision});
            REQUIRE(slid);
            CHECK(slid.outcome == tf::placement_outcome::contact);
            CHECK(relation_by_points(cloud(slid.points), solid) != mesh_relation::penetrating);
            CHECK(std::abs(slid.travel / std::hypot(0.1, 1.0) - time) < 1e-5);
        }
        const tf::mesh within = random_cloud(source, 40, 0.4, {0.5, 0.1, 0.2});
        const auto out = tf::separate(within.points, fixed);
        REQUIRE(out);
        CHECK(out.outcome == tf::placement_outcome::moved_apart);
        CHECK(relation_by_points(cloud(out.points), solid) != mesh_relation::penetrating);
    }
}

TEST_CASE("clouds: points without faces are a cloud in every query, prepared or not") {
    const tf::mesh solid = box(2, 2, 2);
    const std::vector<tf::point3> points{{1, 1, 3}, {5, 5, 5}}, within{{1, 1, 1}}, on{{1, 1, 2}};
    const auto prepared = tf::prepared_mesh::borrow({points});
    for (const tf::mesh_ref& given : {tf::mesh_ref(points), tf::mesh_ref(prepared)}) {
        CHECK(tf::distance(given, solid) == 1.0);
        CHECK(tf::closest_pair(solid, given)->face_b == 0);
        CHECK(tf::closest_point(given, {4, 5, 5})->face == 1);
        CHECK_FALSE(tf::intersects(given, solid));
        CHECK(tf::mesh_intersections(given, solid).pairs.empty());
        CHECK(tf::relation(given, solid).relation == mesh_relation::disjoint);
        CHECK(tf::slide(given, solid, {0, 0, -1}).travel == 1.0);
        CHECK(tf::deviation(given, solid)->distances[0] == 1.0);
    }
    const auto prepared_on = tf::prepared_mesh::borrow({on});
    CHECK(tf::intersects(on, solid));
    CHECK(tf::intersects(solid, prepared_on));
    CHECK(tf::mesh_intersections(on, solid).pairs ==
          tf::mesh_intersections(prepared_on, solid).pairs);
    CHECK(tf::relation(within, solid).relation == mesh_relation::penetrating);
    const auto clashes = tf::clash({solid, within});
    REQUIRE(clashes.pairs.size() == 1);
    CHECK_FALSE(clashes.pairs[0].volume.has_value());
}

TEST_CASE("clouds: they bound nothing, and are no operands") {
    const tf::mesh solid = box(2, 2, 2);
    const std::vector<tf::point3> points{{1, 1, 1}, {9, 9, 9}};
    const auto prepared = tf::prepared_mesh::borrow({points});
    const auto prepared_solid = tf::prepared_mesh::borrow(solid);
    for (const tf::mesh_ref& given : {tf::mesh_ref(points), tf::mesh_ref(prepared)})
        for (const tf::mesh_ref& other : {tf::mesh_ref(solid), tf::mesh_ref(prepared_solid)}) {
            CHECK_THROWS_WITH_AS((void)tf::unite(given, other),
                                 doctest::Contains("operand a: a point cloud is no operand"),
                                 std::invalid_argument);
            CHECK_THROWS_AS((void)tf::difference(other, given), std::invalid_argument);
            CHECK_THROWS_AS((void)tf::unite({other, given, other}), std::invalid_argument);
            CHECK_THROWS_AS((void)tf::check_operand(given), std::invalid_argument);
            CHECK(tf::self_intersections(given).pairs.empty());
            CHECK_THROWS_AS((void)tf::resolve_self_intersections(given), std::invalid_argument);
            CHECK_THROWS_WITH_AS((void)tf::hollow(given, 0.1, {}), doctest::Contains("point cloud"),
                                 std::invalid_argument);
            CHECK(tf::find_invalid_faces(given).degenerate_faces.empty());
        }
    const tf::mesh collapsed{{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 1}}};  // its only face has no area
    CHECK(tf::unite(solid, collapsed).value().faces.size() == solid.faces.size());
}

TEST_CASE("clouds: the same answers on any number of threads") {
    test::random source(9);
    const tf::mesh solid = test::ball(3, 1.0);
    const tf::mesh given = random_cloud(source, 3000, 1.0, {0.0, 1.5, 0.5});
    const auto with = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        const auto m = tf::measure(given, solid);
        return std::vector<double>{
            m->distance, m->surface_distance, static_cast<double>(m->on_a.face),
            static_cast<double>(m->on_b.face), static_cast<double>(m->face_a)};
    };
    const auto one = with(1);
    CHECK(one == with(2));
    CHECK(one == with(8));
}
