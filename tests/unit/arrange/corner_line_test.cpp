#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/exact/box_around.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace {

using tf::implicit_point;
using tf::detail::arrange::corner_line;

using corners = std::array<implicit_point, 3>;

tf::triangle3 centers(const corners& of) {
    return {of[0].center(), of[1].center(), of[2].center()};
}

/// A point of whole numbers from 0 to `most`.
tf::point3 whole(test::random& source, std::size_t most) {
    const auto one = [&] { return static_cast<double>(source.below(most + 1)); };
    return {one(), one(), one()};
}

/// The line of the header for an s that is small, but not smaller than any number. Corners are
/// whole numbers to 3: what is not 0 is 1 at least, times s^2 where it decides.
tf::point3 on_line(const tf::triangle3& t) {
    constexpr double s = 0x1p-9;
    tf::point3 p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = t[0][k] + s * (t[1][k] - t[0][k]) + s * s * (t[2][k] - t[0][k]);
    return p;
}

/// Where lines of whole numbers meet: a face that is far thinner than doubles are apart there.
corners thin_face() {
    const tf::point3 far{1, 1, 0};
    const tf::point3 x{3, 1 + 1.0 / 3, 0}, y{3, std::nextafter(x.y, 2.0), 0};
    const auto cross = [&](const tf::point3& q, double at) {
        return implicit_point::where_lines_cross(far, q, {at, 0, 0}, {at, 5, 0});
    };
    const double here = std::nextafter(1.0, 2.0);
    return {implicit_point(far), cross(x, here), cross(y, here)};
}

}  // namespace

TEST_CASE("corner_line: passes triangles as a line close to the corner does") {
    test::random source(1);
    std::size_t through = 0, ahead = 0, behind = 0, level = 0;
    for (int i = 0; i < 40'000; ++i) {
        const tf::triangle3 own{whole(source, 3), whole(source, 3), whole(source, 3)};
        tf::triangle3 other{whole(source, 3), whole(source, 3), whole(source, 3)};
        if (source.below(4) == 0) other[source.below(3)] = own[source.below(3)];
        const int along = static_cast<int>(source.below(3));
        if (orient2d(along, own[0], own[1], own[2]) == 0) continue;
        const corner_line line({own[0], own[1], own[2]}, along);
        CHECK(line.faces() == orient2d(along, own[0], own[1], own[2]));
        CHECK(line.passes(own) == line.faces());
        CHECK(line.place(own, line.faces()) == 0);

        const tf::point3 p = on_line(own);
        const auto about = [&](std::size_t a, std::size_t b) {
            return orient2d(along, other[a], other[b], p);
        };
        const int turn = about(0, 1);
        const int expected = turn == about(1, 2) && turn == about(2, 0) ? turn : 0;
        REQUIRE(line.passes(other) == expected);
        if (expected == 0) continue;
        const int place = -orient3d(other[0], other[1], other[2], p) * expected;
        REQUIRE(line.place(other, expected) == place);
        ++through;
        ++(place > 0 ? ahead : place < 0 ? behind : level);
    }
    CHECK(through > 1000);
    CHECK(ahead > 100);
    CHECK(behind > 100);
    CHECK(level > 10);
}

TEST_CASE("corner_line: given corners and constructed ones at the same places give one answer") {
    test::random source(2);
    std::size_t through = 0;
    for (int i = 0; i < 5'000; ++i) {
        const tf::triangle3 own{whole(source, 3), whole(source, 3), whole(source, 3)};
        const tf::triangle3 other{whole(source, 3), whole(source, 3), whole(source, 3)};
        const int along = static_cast<int>(source.below(3));
        if (orient2d(along, own[0], own[1], own[2]) == 0) continue;
        const auto constructed = [](const tf::point3& p) {
            return implicit_point::where_lines_cross(
                {p.x - 1, p.y - 2, p.z}, {p.x + 3, p.y + 6, p.z}, {p.x, p.y - 1, p.z - 3},
                {p.x, p.y + 1, p.z + 3});
        };
        const corner_line given({own[0], own[1], own[2]}, along);
        const corner_line built({constructed(own[0]), constructed(own[1]), constructed(own[2])},
                                along);
        CHECK(built.faces() == given.faces());
        const int facing = given.passes(other);
        REQUIRE(built.passes(other) == facing);
        if (facing == 0) continue;
        ++through;
        REQUIRE(built.place(other, facing) == given.place(other, facing));
    }
    CHECK(through > 100);
}

TEST_CASE("corner_line: a face between whose edges there is no double has a line") {
    const corners face = thin_face();
    REQUIRE(orient2d(2, face[0], face[1], face[2]) != 0);
    const tf::triangle3 near = centers(face);  // no area is left of it in doubles
    REQUIRE(orient2d(2, near[0], near[1], near[2]) == 0);
    for (std::size_t turn = 0; turn < 3; ++turn) {
        const corner_line line({face[turn], face[(turn + 1) % 3], face[(turn + 2) % 3]}, 2);
        CHECK(line.faces() == 1);
        const tf::triangle3 above{tf::point3{0, 0, 1}, tf::point3{4, 0, 1}, tf::point3{0, 4, 1}};
        const tf::triangle3 below{tf::point3{0, 0, -1}, tf::point3{0, 4, -1}, tf::point3{4, 0, -1}};
        REQUIRE(line.passes(above) == 1);
        CHECK(line.place(above, 1) == 1);
        REQUIRE(line.passes(below) == -1);
        CHECK(line.place(below, -1) == -1);
        // The line runs between the edges: past triangles that end at one of them.
        const tf::point3 x{3, 1 + 1.0 / 3, 0}, y{3, std::nextafter(x.y, 2.0), 0};
        CHECK(line.passes({tf::point3{1, 1, 0}, tf::point3{3, 0, 0}, x}) == 0);
        CHECK(line.passes({tf::point3{1, 1, 0}, x, y}) == 1);
        CHECK(line.passes({tf::point3{1, 1, 0}, y, tf::point3{3, 5, 0}}) == 0);
    }
}

TEST_CASE("corner_line: corners are in their boxes") {
    const tf::aabb<double, 3> given = tf::detail::exact::box_around(tf::point3{0.1, -2, 3});
    CHECK(given.min[0] == 0.1);
    CHECK(given.max[1] == -2);
    for (const implicit_point& p : thin_face()) {
        const tf::aabb<double, 3> box = tf::detail::exact::box_around(p);
        for (int k = 0; k < 3; ++k) {
            tf::point3 low, high;
            for (std::size_t j = 0; j < 3; ++j) {
                low[j] = box.min[j];
                high[j] = box.max[j];
            }
            CHECK(compare(k, implicit_point(low), p) <= 0);
            CHECK(compare(k, p, implicit_point(high)) <= 0);
        }
    }
}
