/// \file
/// Boxes that triangles and segments certainly miss, against exact triangle pairs.

#include <libmesh/boolean/interval_triangle.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>
#include <support/solids.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace {

using tf::detail::boolean::interval_triangle;
using box3 = tf::aabb<double, 3>;
using corners3 = std::array<tf::point3, 3>;

bool has(const box3& box, const tf::point3& p) {
    for (std::size_t k = 0; k < 3; ++k)
        if (p[k] < box.min[k] || p[k] > box.max[k]) return false;
    return true;
}

/// Exactly. One corner is in the box, or the triangle meets a side of it.
bool meets(const corners3& t, const box3& box) {
    if (std::ranges::any_of(t, [&](const tf::point3& p) { return has(box, p); })) return true;
    tf::mesh sides = test::box(1, 1, 1);
    for (tf::point3& p : sides.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = p[k] > 0.5 ? box.max[k] : box.min[k];
    return std::ranges::any_of(sides.faces, [&](const tf::face& f) {
        const auto [a, b, c] = f;
        return tf::intersect({t[0], t[1], t[2]},
                             {sides.points[a], sides.points[b], sides.points[c]})
                   .count != 0;
    });
}

box3 wider(box3 box, double by) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] -= by;
        box.max[k] += by;
    }
    return box;
}

bool overlaps(const box3& a, const box3& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.max[k] < b.min[k] || b.max[k] < a.min[k]) return false;
    return true;
}

struct question {
    corners3 triangle;
    box3 box;
};

/// Long, thin and small triangles, far away or not, and boxes that overlap theirs.
question ask(test::random& source, double scale, bool on_lattice) {
    const auto number = [&](double size) {
        const double x = source.in(-size, size);
        return on_lattice ? std::round(4 * x) * 0.25 * scale : x * scale;
    };
    const double far = source.below(3) == 0 ? 1000.0 : 0.0;
    const double size = std::exp2(source.in(-3, 3));
    for (;;) {
        question q;
        box3 around;
        for (tf::point3& p : q.triangle) {
            p = {number(size) + far * scale, number(size), number(source.below(2) ? size : 1e-3)};
            around.include(p);
        }
        const tf::point3 at{number(size) + far * scale, number(size), number(size)};
        q.box.include(at);
        q.box.include(tf::point3{at.x + std::abs(number(1)), at.y + std::abs(number(1)),
                                 at.z + std::abs(number(1))});
        if (overlaps(around, q.box)) return q;
    }
}

}  // namespace

TEST_CASE("interval triangle: boxes that it misses are told from it, and no others") {
    test::random source(71);
    std::size_t apart = 0, met = 0;
    for (const double scale : {1.0, 0x1p-200, 0x1p300})
        for (int i = 0; i < 4000; ++i) {
            const question q = ask(source, scale, i % 2 == 0);
            const bool is_apart = interval_triangle(q.triangle).is_apart_from(q.box);
            if (is_apart) {
                CHECK_FALSE(meets(q.triangle, q.box));
                ++apart;
            } else if (meets(q.triangle, wider(q.box, 1e-9 * scale))) {
                ++met;
            } else {
                CHECK_FALSE("a gap of that size is seen");
            }
        }
    CHECK(apart > 1000);
    CHECK(met > 1000);
}

TEST_CASE("interval triangle: whatever their corners are in their boxes") {
    test::random source(72);
    std::size_t apart = 0;
    for (int i = 0; i < 4000; ++i) {
        const question q = ask(source, 1.0, false);
        std::array<box3, 3> boxes;
        for (std::size_t k = 0; k < 3; ++k) {
            boxes[k].include(q.triangle[k]);
            boxes[k] = wider(boxes[k], 0.05);
        }
        const bool is_segment = i % 3 == 0;
        const interval_triangle corners(std::span<const box3>(boxes).first(is_segment ? 2 : 3));
        if (!corners.is_apart_from(q.box)) continue;
        ++apart;
        for (int j = 0; j < 8; ++j) {
            corners3 some;
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    some[k][axis] = source.below(2) ? boxes[k].min[axis] : boxes[k].max[axis];
            if (is_segment) some[2] = some[1];
            CHECK_FALSE(meets(some, q.box));
        }
    }
    CHECK(apart > 300);
}

TEST_CASE("interval triangle: numbers too large or too small to tell are not told apart") {
    const box3 box{{0, 0, 0}, {0x1p600, 0x1p600, 0x1p600}};
    const corners3 large{{{0x1p601, 0, 0}, {0, 0x1p601, 0}, {0x1p601, 0x1p601, 0}}};
    CHECK_FALSE(interval_triangle(large).is_apart_from(box));
    // Products underflow: what is left of them says nothing.
    const double tiny = 0x1p-530;
    const corners3 small{{{3 * tiny, 0, 0}, {0, 3 * tiny, 0}, {0, 0, 3 * tiny}}};
    CHECK_FALSE(
        interval_triangle(small).is_apart_from({{0, 0, 0}, {tiny / 2, tiny / 2, tiny / 2}}));
}
