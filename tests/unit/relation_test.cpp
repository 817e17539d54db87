#include <libmesh/base/face_tree.hpp>
#include <libmesh/place/settle.hpp>
#include <treeform/mesh/first_contact.hpp>
#include <treeform/mesh/mesh_intersections.hpp>
#include <treeform/mesh/relation.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

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
    return found.relation;
}

/// Inside out.
}  // namespace

TEST_CASE("relation: boxes that are apart, touch in every way, or penetrate by an ulp") {
    const tf::mesh b = box(1, 1, 1);
    const double ulp = 0x1p-52;
    CHECK(between(moved(b, {1 + ulp, 0, 0}), b) == mesh_relation::separate);
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
    CHECK(between(small, hollow) == mesh_relation::separate);
    CHECK(between(moved(box(1, 1, 1), {4, 5, 5}), hollow) == mesh_relation::touching);
    CHECK(between(moved(box(1, 1, 1), {3.5, 5, 5}), hollow) == mesh_relation::penetrating);
    CHECK(between(moved(box(1, 1, 1), {2, 5, 5}), hollow) == mesh_relation::penetrating);
    // a second part of the one inside the other
    CHECK(between(together(small, moved(box(1, 1, 1), {50, 0, 0})), big) ==
          mesh_relation::penetrating);
}

TEST_CASE("relation: an open sheet has no inside") {
    tf::mesh open = box(10, 10, 10);
    open.faces.pop_back();
    CHECK(between(moved(box(1, 1, 1), {5, 5, 5}), open) == mesh_relation::separate);
    CHECK(between(moved(box(1, 1, 1), {-1, 5, 5}), open) == mesh_relation::touching);
    CHECK(between(moved(box(1, 1, 1), {-0.5, 5, 5}), open) == mesh_relation::penetrating);
    CHECK(between({}, open) == mesh_relation::separate);
}

TEST_CASE("settle: what fell on something does not penetrate it in the coordinates written") {
    test::random source(3);
    std::size_t stepped_back = 0;
    for (int round = 0; round < 60; ++round) {
        const tf::mesh still = test::ball(2, 1.0 + source.unit());
        tf::mesh falling = test::ball(2, 0.5 + source.unit());
        const double far = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 1e3 : 1e6;
        const tf::point3 offset{far, -far, far};
        falling = moved(falling, {source.in(-0.5, 0.5), source.in(-0.5, 0.5), 4.0});
        const bool single = round % 2 == 0;
        const auto in_place = [&](const tf::mesh& mesh) {
            tf::mesh there = moved(mesh, offset);
            if (single)
                for (tf::point3& p : there.points)
                    p = {double{static_cast<float>(p.x)}, double{static_cast<float>(p.y)},
                         double{static_cast<float>(p.z)}};
            return there;
        };
        const tf::mesh a = in_place(falling), b = in_place(still);
        const tf::tree<3> tree_b = tf::face_tree(b);
        const tf::point3 down{source.in(-0.1, 0.1), source.in(-0.1, 0.1), -1.0};
        const auto contact = tf::first_contact(a, b, down);
        REQUIRE(contact.end == tf::motion_end::contact);
        const auto settled = tf::settle(a, b, tree_b, down, contact.time, {.to_single = single});
        CHECK(settled.relation != mesh_relation::penetrating);
        stepped_back += settled.backed_off > 0;
        // a little further it would
        const double ulp = (4.0 + far) * (single ? 0x1p-23 : 0x1p-52);
        const auto further = tf::settle(a, b, tree_b, down, settled.time + 8 * ulp,
                                        {.to_single = single, .attempts = 0});
        CHECK(further.relation != mesh_relation::separate);
        for (const tf::point3& p : settled.points)
            if (single) CHECK(p.z == double{static_cast<float>(p.z)});
    }
    CHECK(stepped_back > 0);
}

TEST_CASE("settle: times and motions that cannot be meant are refused") {
    const tf::mesh b = box(1, 1, 1);
    const tf::mesh a = moved(b, {0, 0, 3});
    const tf::tree<3> tree = tf::face_tree(b);
    CHECK_THROWS_AS(static_cast<void>(tf::settle(a, b, tree, {0, 0, 0}, 1)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::settle(a, b, tree, {0, 0, -1}, -1)),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::settle(a, b, tree, {0, 0, -1},
                                                 std::numeric_limits<double>::infinity())),
                    std::invalid_argument);
    CHECK(tf::settle(a, b, tree, {0, 0, -1}, 2.0).relation == mesh_relation::touching);
    CHECK(tf::settle(a, b, tree, {0, 0, -1}, 2.0).backed_off == 0);
}
