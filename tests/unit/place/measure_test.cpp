#include <libmesh/place/relation_of.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <optional>

namespace {

using test::box;
using test::moved;
using tf::mesh_relation;

tf::point3 point_of(const tf::mesh& mesh, const tf::surface_point& at) {
    tf::point3 sum{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            sum[k] += at.barycentric[i] * mesh.points[mesh.faces[at.face][i]][k];
    return sum;
}

double between_ends(const tf::point3& a, const tf::point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

void check_points(const tf::mesh& a, const tf::mesh& b, const tf::relation_result& found) {
    CHECK(between_ends(found.on_a.point, found.on_b.point) ==
          doctest::Approx(found.surface_distance).epsilon(1e-14));
    CHECK(between_ends(point_of(a, found.on_a), found.on_a.point) < 1e-13);
    CHECK(between_ends(point_of(b, found.on_b), found.on_b.point) < 1e-13);
    for (const auto& w : {found.on_a.barycentric, found.on_b.barycentric}) {
        CHECK(std::abs(w[0] + w[1] + w[2] - 1.0) < 1e-15);
        for (const double one : w) CHECK((one >= 0.0 && one <= 1.0));
    }
}

}  // namespace

TEST_CASE("measure: of nothing there is nothing to say") {
    CHECK_FALSE(tf::measure(tf::mesh{}, box(1, 1, 1)).has_value());
    CHECK_FALSE(tf::measure(box(1, 1, 1), tf::mesh{}).has_value());
}

TEST_CASE("measure: boxes apart, touching, through each other, inside") {
    const tf::mesh b = box(4, 4, 4);
    const tf::mesh a = box(1, 1, 1);
    const auto at = [&](double x, double y, double z) {
        const tf::mesh there = moved(a, {x, y, z});
        const auto found = tf::measure(there, b);
        REQUIRE(found.has_value());
        check_points(there, b, *found);
        return *found;
    };
    const auto apart = at(7, 1, 1);
    CHECK(apart.relation == mesh_relation::disjoint);
    CHECK(apart.distance == 3.0);
    CHECK(apart.surface_distance == 3.0);
    const auto touching = at(4, 1, 1);
    CHECK(touching.relation == mesh_relation::touching);
    CHECK(touching.distance == 0.0);
    CHECK(touching.surface_distance == 0.0);
    CHECK(touching.on_a.point == touching.on_b.point);
    const auto through = at(3.5, 1, 1);
    CHECK(through.relation == mesh_relation::penetrating);
    CHECK(through.distance == 0.0);
    CHECK(through.surface_distance == 0.0);
    const auto inside = at(1, 1.25, 1.5);
    CHECK(inside.relation == mesh_relation::penetrating);
    CHECK(inside.a_inside_b);
    CHECK(inside.distance == 0.0);
    CHECK(inside.surface_distance == 1.0);
}

TEST_CASE("measure: swapping the meshes swaps the answer") {
    test::random source(11);
    for (int round = 0; round < 20; ++round) {
        const tf::mesh a = test::ball(2, 0.5 + source.unit());
        const tf::mesh b = moved(test::ball(2, 0.5 + source.unit()),
                                 {source.in(-3, 3), source.in(-3, 3), source.in(-3, 3)});
        const auto one = tf::measure(a, b);
        const auto two = tf::measure(b, a);
        REQUIRE((one && two));
        CHECK(one->relation == two->relation);
        CHECK(one->distance == doctest::Approx(two->distance).epsilon(1e-14));
        check_points(a, b, *one);
    }
}

TEST_CASE("measure: weights give points of slivers, segments and single points") {
    test::random source(5);
    for (int round = 0; round < 2000; ++round) {
        const double thin = std::ldexp(1.0, -static_cast<int>(source.below(60)));
        std::array<tf::point3, 3> t;
        for (tf::point3& p : t) p = {source.unit(), thin * source.unit(), thin * source.unit()};
        if (round % 7 == 0) t[2] = t[1];
        if (round % 49 == 0) t[1] = t[2] = t[0];
        double u = source.unit(), v = source.unit();
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        tf::point3 p{};
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = t[0][k] + u * (t[1][k] - t[0][k]) + v * (t[2][k] - t[0][k]);
        const auto w = tf::detail::place::barycentric_weights(t, p);
        tf::point3 q{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) q[k] += w[i] * t[i][k];
        CHECK(between_ends(p, q) < 1e-9);
        CHECK(std::abs(w[0] + w[1] + w[2] - 1.0) < 1e-15);
    }
}
