#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace {

using test::box;
using test::inside_out;
using test::moved;
using test::together;
using tf::mesh_relation;

mesh_relation between(const tf::mesh& a, const tf::mesh& b) {
    const auto found = tf::relation(a, b);
    const auto swapped = tf::relation(b, a);
    CHECK(found.relation == swapped.relation);
    CHECK(found.a_inside_b == swapped.b_inside_a);
    CHECK(std::isnan(found.distance));
    return found.relation;
}

}  // namespace

TEST_CASE("relation: boxes that are apart, touch in every way, or penetrate by an ulp") {
    const tf::mesh b = box(1, 1, 1);
    const double ulp = 0x1p-52;
    CHECK(between(moved(b, {1 + ulp, 0, 0}), b) == mesh_relation::disjoint);
    CHECK(between(moved(b, {1, 0, 0}), b) == mesh_relation::touching);       // faces
    CHECK(between(moved(b, {1, 0.5, 0.25}), b) == mesh_relation::touching);  // parts of faces
    CHECK(between(moved(b, {1, 1, 0}), b) == mesh_relation::touching);       // edges
    CHECK(between(moved(b, {1, 1, 1}), b) == mesh_relation::touching);       // corners
    CHECK(between(moved(b, {1 - ulp, 0.5, 0.25}), b) == mesh_relation::penetrating);
    CHECK(between(moved(b, {1 - ulp, 0, 0}), b) == mesh_relation::penetrating);  // faces slide
    CHECK(between(b, b) == mesh_relation::penetrating);                          // the same place
    CHECK(between(moved(box(3, 3, 3), {-1, -1, -1}), b) == mesh_relation::penetrating);
    CHECK(between(moved(box(1, 3, 1), {0, -1, 0}), box(1, 1, 1)) == mesh_relation::penetrating);
}

TEST_CASE("relation: a body in a solid is inside it, in a cavity it is not") {
    const tf::mesh small = moved(box(1, 1, 1), {5, 5, 5});
    const tf::mesh big = box(10, 10, 10);
    const auto inside = tf::relation(small, big);
    CHECK(inside.relation == mesh_relation::penetrating);
    CHECK(inside.a_inside_b);
    CHECK_FALSE(inside.b_inside_a);
    const tf::mesh hollow = together(big, inside_out(moved(box(4, 4, 4), {4, 4, 4})));
    CHECK(between(small, hollow) == mesh_relation::disjoint);
    CHECK(between(moved(box(1, 1, 1), {4, 5, 5}), hollow) == mesh_relation::touching);
    CHECK(between(moved(box(1, 1, 1), {3.5, 5, 5}), hollow) == mesh_relation::penetrating);
    CHECK(between(moved(box(1, 1, 1), {2, 5, 5}), hollow) == mesh_relation::penetrating);
    // a second part of the one inside the other
    CHECK(between(together(small, moved(box(1, 1, 1), {50, 0, 0})), big) ==
          mesh_relation::penetrating);
}

TEST_CASE("relation: solids that are inside out are the same solids") {
    test::random source(5);
    std::array<std::size_t, 3> seen{};
    for (int i = 0; i < 400; ++i) {
        tf::mesh a = test::lattice_box(source), b = test::lattice_box(source);
        if (i % 4 == 1)  // a hollow one
            a = together(moved(box(5, 5, 5), {-1, -1, -1}), inside_out(a));
        if (i % 4 == 2) a = test::unjoined(a);
        if (i % 4 == 3) b = together(b, moved(test::lattice_box(source), {9, 0, 0}));
        const mesh_relation how = between(a, b);
        ++seen[static_cast<std::size_t>(how)];
        CHECK(between(inside_out(a), b) == how);
        CHECK(between(a, inside_out(b)) == how);
        CHECK(between(inside_out(a), inside_out(b)) == how);
    }
    for (const std::size_t count : seen) CHECK(count > 10);
}

TEST_CASE("relation: of two components, each is taken the way it faces") {
    const tf::mesh b = box(1, 1, 1);
    const tf::mesh mixed = together(inside_out(b), moved(b, {3, 0, 0}));
    CHECK(between(mixed, moved(b, {0.5, 0, 0})) == mesh_relation::penetrating);
    CHECK(between(mixed, moved(b, {3.5, 0, 0})) == mesh_relation::penetrating);
    CHECK(between(mixed, moved(b, {1, 0, 0})) == mesh_relation::touching);
    CHECK(between(mixed, moved(b, {2, 0, 0})) == mesh_relation::touching);
    // A shell in a shell that faces the same way: what is between them and within both is inside.
    const tf::mesh twice = together(box(5, 5, 5), moved(box(3, 3, 3), {1, 1, 1}));
    CHECK(between(twice, moved(b, {4, 1, 1})) == mesh_relation::penetrating);
    CHECK(between(twice, moved(b, {1, 1, 1})) == mesh_relation::penetrating);
    CHECK(between(twice, moved(b, {5, 1, 1})) == mesh_relation::touching);
    CHECK(between(inside_out(twice), moved(b, {5, 1, 1})) == mesh_relation::touching);
}

TEST_CASE("count_inside_out: components that are, and are in no other one") {
    const tf::mesh b = box(1, 1, 1), big = moved(box(5, 5, 5), {-2, -2, -2});
    CHECK(tf::count_inside_out(tf::mesh{}) == 0);
    CHECK(tf::count_inside_out(b) == 0);
    CHECK(tf::count_inside_out(inside_out(b)) == 1);
    CHECK(tf::count_inside_out(test::unjoined(inside_out(b))) == 1);
    CHECK(tf::count_inside_out(together(big, inside_out(b))) == 0);  // a cavity
    CHECK(tf::count_inside_out(inside_out(together(big, inside_out(b)))) == 1);
    CHECK(tf::count_inside_out(together(b, moved(inside_out(b), {2, 0, 0}))) == 1);
    CHECK(tf::count_inside_out(together(b, moved(inside_out(b), {1, 1, 1}))) == 1);  // by a corner
    tf::mesh open = inside_out(b);
    open.faces.pop_back();
    CHECK(tf::count_inside_out(open) == 0);
    CHECK(tf::count_inside_out(b.points) == 0);
    CHECK(tf::count_inside_out(moved(inside_out(b), {1e9, -1e9, 1e9})) == 1);
    open.faces[0][0] = 99;
    CHECK_THROWS_AS(static_cast<void>(tf::count_inside_out(open)), std::invalid_argument);
}

TEST_CASE("relation: an open sheet has no inside") {
    tf::mesh open = box(10, 10, 10);
    open.faces.pop_back();
    CHECK(between(moved(box(1, 1, 1), {5, 5, 5}), open) == mesh_relation::disjoint);
    CHECK(between(moved(box(1, 1, 1), {-1, 5, 5}), open) == mesh_relation::touching);
    CHECK(between(moved(box(1, 1, 1), {-0.5, 5, 5}), open) == mesh_relation::penetrating);
    CHECK(between({}, open) == mesh_relation::disjoint);
}

TEST_CASE("relation: corners that a file repeats are one vertex, unless told otherwise") {
    const tf::mesh big = test::unjoined(box(10, 10, 10));
    const tf::mesh small = moved(test::unjoined(box(1, 1, 1)), {5, 5, 5});
    CHECK(between(small, big) == mesh_relation::penetrating);
    CHECK(tf::relation(small, big).a_inside_b);
    CHECK(tf::relation(small, big, {.vertices = tf::vertex_identity::by_index}).relation ==
          mesh_relation::disjoint);
    const auto same = test::unjoined(box(1, 1, 1));
    CHECK(between(same, box(1, 1, 1)) == mesh_relation::penetrating);  // faces look the same way
    CHECK(tf::relation(same, same, {.vertices = tf::vertex_identity::by_index}).relation ==
          mesh_relation::touching);
}

TEST_CASE("relation: a prepared mesh gives the same answers, and builds its indexes once") {
    test::random source(4);
    const tf::mesh still = test::unjoined(test::ball(2, 1.0));
    const auto prepared = tf::prepared_mesh::borrow(still);
    CHECK(prepared.indexes_built() == 0);
    std::uint64_t built = 0;
    for (int round = 0; round < 40; ++round) {
        const tf::mesh a = moved(test::ball(1, 0.3), {source.in(-2, 2), source.in(-2, 2), 0.0});
        const auto expected = tf::relation(a, still);
        const auto found = tf::relation(tf::prepared_mesh::borrow(a), prepared);
        CHECK(found.relation == expected.relation);
        CHECK(found.face_a == expected.face_a);
        CHECK(found.face_b == expected.face_b);
        built = std::max(built, prepared.indexes_built());
    }
    CHECK(built == 3);  // the tree, joined corners, whether it is closed
}

TEST_CASE("relation: what is refused is named") {
    tf::mesh bad = box(1, 1, 1);
    bad.faces[3][1] = 99;
    CHECK_THROWS_WITH_AS(
        static_cast<void>(tf::relation(box(1, 1, 1), bad)),
        doctest::Contains("treeform::relation: b: face 3 has a corner out of range"),
        std::invalid_argument);
    bad = box(1, 1, 1);
    bad.points[bad.faces[2][0]].y = std::nan("");
    CHECK_THROWS_AS(static_cast<void>(tf::relation(bad, bad)), std::invalid_argument);
}
