#include "support/reference_intersection.hpp"
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace {

using tf::feature_pair;
using tf::intersect;
using tf::point3;
using tf::triangle3;
using tf::triangle_contact;
using tf::triangle_feature;
using tf::test::integral;
using enum tf::triangle_feature;

/// The triangle every hand-made case is about: the half of a square, 4 wide, normal upwards.
const triangle3 base{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

/// A point of `base` on each of its features, in the order of their names.
const std::array<point3, 7> witness{
    {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}}};

triangle_feature nth(std::size_t i) { return static_cast<triangle_feature>(i); }
int index_of(triangle_feature f) { return static_cast<int>(f) % 3; }

point3 plus(const point3& p, const point3& v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
triangle3 moved(const triangle3& t, const point3& v) {
    return {plus(t[0], v), plus(t[1], v), plus(t[2], v)};
}
triangle3 flipped(const triangle3& t) { return {t[0], t[2], t[1]}; }

bool has(const triangle_contact& found, feature_pair end) {
    return std::find(found.ends.begin(), found.ends.begin() + found.count, end) !=
           found.ends.begin() + found.count;
}

std::set<std::pair<triangle_feature, triangle_feature>> ends_of(const triangle_contact& found) {
    std::set<std::pair<triangle_feature, triangle_feature>> ends;
    for (std::size_t i = 0; i < found.count; ++i)
        ends.emplace(found.ends[i].on_a, found.ends[i].on_b);
    CHECK(ends.size() == found.count);
    return ends;
}
using names = std::set<std::pair<triangle_feature, triangle_feature>>;

/// `t` with corner i at the place of corner order[i], and what that makes of a name.
triangle3 reordered(const triangle3& t, const std::array<int, 3>& order) {
    const auto at = [&](std::size_t i) { return t[static_cast<std::size_t>(order[i])]; };
    return {at(0), at(1), at(2)};
}
triangle_feature original_name(triangle_feature f, const std::array<int, 3>& order) {
    if (f == interior) return f;
    const int i = order[static_cast<std::size_t>(index_of(f))];
    if (f <= v2) return static_cast<triangle_feature>(i);
    const int k = order[static_cast<std::size_t>((index_of(f) + 1) % 3)];
    return static_cast<triangle_feature>(3 + ((i + 1) % 3 == k ? i : k));
}
constexpr std::array<std::array<int, 3>, 6> orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

tf::test::reference_contact reference(const triangle3& a, const triangle3& b) {
    return tf::test::reference_intersection<std::int64_t>(integral(a), integral(b)).answer();
}

/// Corners on the integer points 0..size along each axis.
triangle3 lattice_triangle(std::mt19937_64& engine, unsigned size_x, unsigned size_y,
                           unsigned size_z) {
    const auto upto = [&](unsigned n) { return static_cast<double>(engine() % (n + 1)); };
    triangle3 t;
    for (point3& p : t) p = {upto(size_x), upto(size_y), upto(size_z)};
    return t;
}

}  // namespace

TEST_CASE("triangles with a plane between them have nothing in common") {
    const auto found = intersect(base, moved(base, {0, 0, 1}));
    CHECK(found.count == 0);
    CHECK(found.count == 0);
    CHECK_FALSE(found.coplanar);
    CHECK_FALSE(found.crossing);
}

TEST_CASE("triangles whose planes they reach may still pass each other by") {
    const triangle3 beside{{{3, 3, -1}, {5, 3, -1}, {4, 3, 1}}};
    CHECK(intersect(base, beside).count == 0);
    CHECK(intersect(beside, base).count == 0);
}

TEST_CASE("a crossing has a segment whose ends are named") {
    SUBCASE("two edges of one pierce the other") {
        const triangle3 blade{{{1, 0.5, -1}, {1, 1.5, -1}, {1, 1, 1}}};
        const auto found = intersect(base, blade);
        CHECK(found.count == 2);
        CHECK(found.crossing);
        CHECK(ends_of(found) == names{{interior, e1}, {interior, e2}});
    }
    SUBCASE("an edge of each pierces the other") {
        const triangle3 blade{{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}};
        const auto found = intersect(base, blade);
        CHECK(found.crossing);
        CHECK(ends_of(found) == names{{e0, interior}, {interior, e1}});
    }
    SUBCASE("the other way around") {
        const triangle3 blade{{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}};
        const auto found = intersect(blade, base);
        CHECK(found.crossing);
        CHECK(ends_of(found) == names{{interior, e0}, {e1, interior}});
    }
}

TEST_CASE("a segment on the rim of one triangle is no crossing") {
    const triangle3 wall{{{1, 1, 0}, {2, 1, 0}, {1, 1, 2}}};
    const auto found = intersect(base, wall);
    CHECK(found.count == 2);
    CHECK_FALSE(found.crossing);
    CHECK(ends_of(found) == names{{interior, v0}, {interior, v1}});
}

TEST_CASE("a corner on any feature is a touch at one named point") {
    // The other corners are above the plane of `base`.
    for (std::size_t f = 0; f < 7; ++f)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            CAPTURE(f);
            CAPTURE(corner);
            triangle3 above{{{5, 1, 3}, {1, 5, 4}, {-1, -1, 5}}};
            above[corner] = witness[f];
            const auto found = intersect(base, above);
            CHECK(found.count == 1);
            CHECK(found.count == 1);
            CHECK(found.ends[0] == feature_pair{nth(f), nth(corner)});
            const auto swapped = intersect(above, base);
            CHECK(swapped.count == 1);
            CHECK(swapped.ends[0] == feature_pair{nth(corner), nth(f)});
        }
}

TEST_CASE("every feature of one meets every feature of the other, except two interiors") {
    // Turned about the witness point so that the planes cross; y and z of the copy change places.
    const auto upright = [](const triangle3& t) {
        triangle3 up;
        for (std::size_t i = 0; i < 3; ++i) up[i] = {t[i].x, t[i].z, t[i].y};
        return up;
    };
    for (std::size_t f = 0; f < 7; ++f)
        for (std::size_t g = 0; g < 7; ++g) {
            CAPTURE(f);
            CAPTURE(g);
            const triangle3 standing = upright(base);
            const point3 from = upright({witness[g], witness[g], witness[g]})[0];
            const point3 to = witness[f];
            const triangle3 b = moved(standing, {to.x - from.x, to.y - from.y, to.z - from.z});
            const auto found = intersect(base, b);
            CHECK(found.count >= 1);
            CHECK(agrees(found, reference(base, b)));
            // Where both planes' common line runs along a feature, its ends are elsewhere.
            const bool along_a = nth(f) == e0 || nth(f) == interior;
            const bool along_b = nth(g) == e0 || nth(g) == interior;
            if (!(along_a && along_b)) CHECK(has(found, {nth(f), nth(g)}));
        }
    // The pairs left over: an edge along the common line, crossed by the other's edge or corner,
    // and an edge through an interior.
    const triangle3 steep{{{2, -1, -1}, {2, 1, 1}, {2, 3, -1}}};
    CHECK(has(intersect(base, steep), {e0, e0}));
    const triangle3 through{{{1, 1, -1}, {1, 1, 1}, {9, 9, 0}}};
    CHECK(has(intersect(base, through), {interior, e0}));
    CHECK(has(intersect(through, base), {e0, interior}));
}

TEST_CASE("triangles that share an edge or a corner report it") {
    const triangle3 roof{{{4, 0, 0}, {0, 0, 0}, {0, -4, 3}}};
    const auto edge = intersect(base, roof);
    CHECK(edge.count == 2);
    CHECK_FALSE(edge.crossing);
    CHECK_FALSE(edge.coplanar);
    CHECK(ends_of(edge) == names{{v0, v1}, {v1, v0}});

    const triangle3 vane{{{0, 0, 0}, {-1, -1, 2}, {-2, -1, 3}}};
    CHECK(ends_of(intersect(base, vane)) == names{{v0, v0}});

    const triangle3 pierce{{{0, 0, 0}, {2, 2, 2}, {2, 2, -2}}};
    const auto found = intersect(base, pierce);
    CHECK(found.crossing);
    CHECK(ends_of(found) == names{{v0, v0}, {e1, e1}});
}

TEST_CASE("coplanar triangles apart are coplanar all the same") {
    const auto found = intersect(base, moved(base, {5, 0, 0}));
    CHECK(found.count == 0);
    CHECK(found.coplanar);
}

TEST_CASE("coplanar triangles can touch at a corner or along an edge") {
    CHECK(ends_of(intersect(base, moved(base, {4, 0, 0}))) == names{{v1, v0}});
    CHECK(ends_of(intersect(base, moved(base, {2, 2, 0}))) == names{{e1, v0}});
    const triangle3 other_half{{{4, 4, 0}, {0, 4, 0}, {4, 0, 0}}};
    const auto edge = intersect(base, other_half);
    CHECK(edge.count == 2);
    CHECK(edge.coplanar);
    CHECK_FALSE(edge.crossing);
    CHECK(ends_of(edge) == names{{v1, v2}, {v2, v1}});
    const triangle3 part{{{1, 0, 0}, {5, 0, 0}, {1, -4, 0}}};
    CHECK(ends_of(intersect(base, part)) == names{{e0, v0}, {v1, e0}});
}

TEST_CASE("the corners of a coplanar area come counter-clockwise as the first triangle runs") {
    const auto ends = [](const triangle_contact& found) {
        return std::vector<feature_pair>(found.ends.begin(), found.ends.begin() + found.count);
    };
    using list = std::vector<feature_pair>;
    SUBCASE("identical") {
        const auto found = intersect(base, base);
        CHECK(found.count >= 3);
        CHECK(found.coplanar);
        CHECK_FALSE(found.crossing);
        CHECK(agrees(found, reference(base, base)));
        CHECK(ends_of(found) == names{{v0, v0}, {v1, v1}, {v2, v2}});
    }
    SUBCASE("flipped") {
        const auto found = intersect(base, flipped(base));
        CHECK(agrees(found, reference(base, flipped(base))));
        CHECK(ends_of(found) == names{{v0, v0}, {v1, v2}, {v2, v1}});
    }
    SUBCASE("contained") {
        const triangle3 inner{{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}};
        CHECK(ends(intersect(base, inner)) == list{{interior, v0}, {interior, v1}, {interior, v2}});
        CHECK(ends(intersect(base, flipped(inner))) ==
              list{{interior, v0}, {interior, v2}, {interior, v1}});
        CHECK(ends_of(intersect(inner, base)) ==
              names{{v0, interior}, {v1, interior}, {v2, interior}});
    }
    SUBCASE("a hexagon") {
        const triangle3 star{{{3, 3, 0}, {-1, 3, 0}, {3, -1, 0}}};
        for (const triangle3& b : {star, flipped(star)}) {
            const auto found = intersect(base, b);
            CHECK(found.count == 6);
            CHECK(found.count >= 3);
            CHECK(agrees(found, reference(base, b)));
        }
        CHECK(ends_of(intersect(base, star)) ==
              names{{e0, e1}, {e0, e2}, {e1, e2}, {e1, e0}, {e2, e0}, {e2, e1}});
    }
    SUBCASE("a triangle, a quadrilateral and a pentagon") {
        CHECK(intersect(base, moved(base, {1, 1, 0})).count == 3);
        const triangle3 bar{{{1, -1, 0}, {1, 9, 0}, {-9, 9, 0}}};
        CHECK(intersect(base, bar).count == 4);
        const triangle3 wide{{{-1, -1, 0}, {3, -1, 0}, {3, 9, 0}}};
        CHECK(agrees(intersect(base, wide), reference(base, wide)));
    }
}

TEST_CASE("a point meets a triangle where it lies") {
    for (std::size_t f = 0; f < 7; ++f) {
        const triangle3 point{witness[f], witness[f], witness[f]};
        const auto found = intersect(base, point);
        CHECK(found.count == 1);
        CHECK(found.coplanar);
        CHECK(found.ends[0] == feature_pair{nth(f), v0});
        CHECK(intersect(point, base).ends[0] == feature_pair{v0, nth(f)});
        CHECK(intersect(point, point).ends[0] == feature_pair{v0, v0});
    }
    const point3 off{1, 1, 1};
    CHECK(intersect(base, {off, off, off}).count == 0);
    CHECK_FALSE(intersect(base, {off, off, off}).coplanar);
    const point3 beside{3, 3, 0};
    CHECK(intersect(base, {beside, beside, beside}).count == 0);
    CHECK(intersect(base, {beside, beside, beside}).coplanar);
}

TEST_CASE("a triangle without area is the segment of its corners") {
    SUBCASE("through the interior, between two corners and on the one between them") {
        const triangle3 needle{{{1, 1, -1}, {1, 1, 3}, {1, 1, 1}}};
        const auto found = intersect(base, needle);
        CHECK(found.count == 1);
        CHECK_FALSE(found.crossing);
        CHECK_FALSE(found.coplanar);
        // v0 to v2 is edge e2, but e0 from v0 to v1 holds the point as well.
        CHECK(ends_of(found) == names{{interior, e0}});
        CHECK(ends_of(intersect(base, {needle[2], needle[0], needle[1]})) == names{{interior, e0}});
        const triangle3 pinned{{{1, 1, -1}, {1, 1, 3}, {1, 1, 0}}};
        CHECK(ends_of(intersect(base, pinned)) == names{{interior, v2}});
    }
    SUBCASE("in the plane, cut short by the triangle") {
        const triangle3 bar{{{-1, 1, 0}, {5, 1, 0}, {1, 1, 0}}};
        const auto found = intersect(base, bar);
        CHECK(found.count == 2);
        CHECK(found.coplanar);
        CHECK(ends_of(found) == names{{e2, e0}, {e1, e0}});
    }
    SUBCASE("along an edge") {
        const triangle3 bar{{{1, 0, 0}, {1, 0, 0}, {9, 0, 0}}};
        CHECK(ends_of(intersect(base, bar)) == names{{e0, v0}, {v1, e1}});
    }
    SUBCASE("two on one line") {
        const triangle3 one{{{0, 0, 0}, {2, 2, 2}, {6, 6, 6}}};
        const triangle3 two{{{8, 8, 8}, {2, 2, 2}, {4, 4, 4}}};
        const auto found = intersect(one, two);
        CHECK(found.count == 2);
        CHECK(found.coplanar);
        CHECK(ends_of(found) == names{{v1, v1}, {v2, e0}});
        CHECK(intersect(one, moved(one, {7, 7, 7})).count == 0);
        CHECK(ends_of(intersect(one, moved(one, {6, 6, 6}))) == names{{v2, v0}});
    }
    SUBCASE("two that cross, and two that pass") {
        const triangle3 one{{{0, 0, 0}, {4, 4, 4}, {2, 2, 2}}};
        const triangle3 two{{{4, 0, 0}, {0, 4, 4}, {0, 4, 4}}};
        CHECK(ends_of(intersect(one, two)) == names{{v2, e0}});
        CHECK(intersect(one, two).coplanar);
        CHECK(intersect(one, moved(two, {0, 1, 0})).count == 0);
        CHECK_FALSE(intersect(one, moved(two, {0, 1, 0})).coplanar);
    }
}

TEST_CASE("the answer is that of exact clipping on small lattices") {
    std::mt19937_64 engine(1);
    std::array<int, 4> seen{};
    std::array<int, 7> by_count{};
    int degenerate = 0;
    for (int trial = 0; trial < 60000; ++trial) {
        CAPTURE(trial);
        const unsigned depth = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 1 : 3;
        const triangle3 a = lattice_triangle(engine, 3, 3, depth);
        const triangle3 b = lattice_triangle(engine, 3, 3, depth);
        const auto expected = reference(a, b);
        REQUIRE(agrees(intersect(a, b), expected));
        ++seen[std::min<std::size_t>(expected.ends.size(), 3)];
        ++by_count[expected.ends.size()];
        degenerate += expected.degenerate;
    }
    for (const int count : seen) CHECK(count > 5000);
    for (const int count : by_count) CHECK(count > 10);
    CHECK(degenerate > 3000);
}

TEST_CASE("neither the order of corners nor of triangles nor of axes changes the answer") {
    std::mt19937_64 engine(2);
    for (int trial = 0; trial < 3000; ++trial) {
        CAPTURE(trial);
        const triangle3 a = lattice_triangle(engine, 3, 3, 2);
        const triangle3 b = lattice_triangle(engine, 3, 3, 2);
        const auto expected = reference(a, b);
        if (expected.degenerate) continue;  // named by number, which the order changes
        names ends;
        for (const feature_pair c : expected.ends) ends.emplace(c.on_a, c.on_b);

        for (const auto& order_a : orders)
            for (const auto& order_b : orders) {
                const auto found = intersect(reordered(a, order_a), reordered(b, order_b));
                names renamed;
                for (const auto& [f, g] : ends_of(found))
                    renamed.emplace(original_name(f, order_a), original_name(g, order_b));
                REQUIRE(renamed == ends);
                REQUIRE(found.crossing == expected.crossing);
                REQUIRE(found.coplanar == expected.coplanar);
            }
        names mirrored;
        for (const auto& [f, g] : ends_of(intersect(b, a))) mirrored.emplace(g, f);
        REQUIRE(mirrored == ends);
        for (const auto& axes : orders) {
            const auto turned = [&](const triangle3& t) {
                triangle3 result;
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        result[i][axis] = t[i][static_cast<std::size_t>(axes[axis])];
                return result;
            };
            REQUIRE(ends_of(intersect(turned(a), turned(b))) == ends);
        }
    }
}

TEST_CASE("scaling by a power of two changes nothing, down to denormals") {
    std::mt19937_64 engine(3);
    for (int trial = 0; trial < 1000; ++trial) {
        const triangle3 a = lattice_triangle(engine, 3, 3, 2);
        const triangle3 b = lattice_triangle(engine, 3, 3, 2);
        const auto expected = reference(a, b);
        for (const double factor : {0x1p-1074, 0x1p-1000, 0x1p-400, 0x1p300, 0x1p1020, -0x1p-3}) {
            const auto scaled = [&](const triangle3& t) {
                triangle3 result;
                for (std::size_t i = 0; i < 3; ++i)
                    result[i] = {t[i].x * factor, t[i].y * factor, t[i].z * factor};
                return result;
            };
            REQUIRE(agrees(intersect(scaled(a), scaled(b)), expected));
        }
    }
}

TEST_CASE("counters say what a verdict cost") {
    tf::predicate_counters counters;
    (void)intersect(base, moved(base, {0, 0, 1}), &counters);
    CHECK(counters.calls <= 6);
    counters = {};
    (void)intersect(base, {{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}}, &counters);
    CHECK(counters.calls >= 6);
    CHECK(counters.calls <= 10);
}
