/// \file
/// Changes that must not change a verdict, on every family of hard pairs: the order of corners, of
/// triangles and of axes, and the unit of length by powers of two.
///
/// Pairs a family: 2000, or $TREEFORM_STRESS_COUNT.

#include "support/settings.hpp"
#include "support/stress_families.hpp"
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace {

using tf::intersect;
using tf::point3;
using tf::triangle3;
using tf::triangle_contact;
using tf::triangle_feature;
using tf::test::stress_family;
using tf::test::triangle_pair;

using names = std::set<std::pair<triangle_feature, triangle_feature>>;
using order = std::array<std::size_t, 3>;
constexpr std::array<order, 6> orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

triangle3 reordered(const triangle3& t, const order& corners) {
    return {t[corners[0]], t[corners[1]], t[corners[2]]};
}

/// What a feature of the reordered triangle is called on the original.
triangle_feature original_name(triangle_feature f, const order& corners) {
    if (f == triangle_feature::interior) return f;
    const std::size_t i = static_cast<std::size_t>(f) % 3;
    const std::size_t from = corners[i];
    if (f <= triangle_feature::v2) return static_cast<triangle_feature>(from);
    const std::size_t to = corners[(i + 1) % 3];
    return static_cast<triangle_feature>(3 + ((from + 1) % 3 == to ? from : to));
}

names ends_of(const triangle_contact& found, const order& order_a = orders[0],
              const order& order_b = orders[0]) {
    names ends;
    for (std::size_t i = 0; i < found.count; ++i)
        ends.emplace(original_name(found.ends[i].on_a, order_a),
                     original_name(found.ends[i].on_b, order_b));
    return ends;
}

bool same_class(const triangle_contact& p, const triangle_contact& q) {
    return p.coplanar == q.coplanar && p.crossing == q.crossing && p.count == q.count;
}

bool is_degenerate(const triangle3& t) { return tf::intersect(t, t).count < 3; }

void check_corner_orders(const triangle_pair& pair, const triangle_contact& found) {
    // On a degenerate triangle names go by number, so only the class can be compared.
    const bool named = !is_degenerate(pair.a) && !is_degenerate(pair.b);
    for (const order& of_a : orders)
        for (const order& of_b : orders) {
            const auto other = tf::intersect(reordered(pair.a, of_a), reordered(pair.b, of_b));
            REQUIRE(same_class(other, found));
            if (named) REQUIRE(ends_of(other, of_a, of_b) == ends_of(found));
        }
}

void check_swap(const triangle_pair& pair, const triangle_contact& found) {
    const auto swapped = tf::intersect(pair.b, pair.a);
    names mirrored;
    for (const auto& [on_b, on_a] : ends_of(swapped)) mirrored.emplace(on_a, on_b);
    REQUIRE(same_class(swapped, found));
    REQUIRE(mirrored == ends_of(found));
}

template <class Change>
void check_change(const triangle_pair& pair, const triangle_contact& found, Change change) {
    const auto all = [&](const triangle3& t) -> triangle3 {
        return {change(t[0]), change(t[1]), change(t[2])};
    };
    const auto other = tf::intersect(all(pair.a), all(pair.b));
    REQUIRE(same_class(other, found));
    REQUIRE(ends_of(other) == ends_of(found));
}

/// Smallest and largest exponent of the coordinates' bits.
std::pair<int, int> exponents(const triangle_pair& pair) {
    int low = 2000;
    int high = -2000;
    for (const triangle3* t : {&pair.a, &pair.b})
        for (const point3& p : *t)
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (p[axis] != 0.0) {
                    low = std::min(low, std::max(std::ilogb(p[axis]), -1022) - 52);
                    high = std::max(high, std::ilogb(p[axis]));
                }
    return {low, high};
}

void check_scales(const triangle_pair& pair, const triangle_contact& found) {
    const auto [low, high] = exponents(pair);
    for (const int exponent : {-1074 - low, -300, 300, 1023 - high}) {
        if (low + exponent < -1074 || high + exponent > 1023) continue;  // would round
        check_change(pair, found, [&](const point3& p) {
            return point3{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                          std::ldexp(p.z, exponent)};
        });
    }
}

std::uint64_t pairs_a_family() { return test::stress_count(2000); }

}  // namespace

TEST_CASE("no family's verdicts depend on orders, axes or a power-of-two unit") {
    const std::uint64_t count = pairs_a_family();
    for (std::size_t f = 0; f < tf::test::stress_family_count; ++f) {
        const auto family = static_cast<stress_family>(f);
        CAPTURE(name_of(family));
        tf::test::stress_stream stream(family, 3);
        for (std::uint64_t i = 0; i < count; ++i) {
            CAPTURE(i);
            const triangle_pair pair = stream.next();
            const triangle_contact found = tf::intersect(pair.a, pair.b);
            check_corner_orders(pair, found);
            check_swap(pair, found);
            for (const order& axes : orders)
                check_change(pair, found, [&](const point3& p) {
                    return point3{p[axes[0]], p[axes[1]], p[axes[2]]};
                });
            check_change(pair, found, [](const point3& p) { return point3{-p.x, p.y, -p.z}; });
            check_scales(pair, found);
        }
    }
}

#ifdef __SSE2__
TEST_CASE("a processor that flushes denormals to zero comes to the same verdicts") {
    const std::uint64_t count = pairs_a_family();
    tf::test::stress_stream stream(stress_family::extreme_range, 4);
    for (std::uint64_t i = 0; i < count; ++i) {
        CAPTURE(i);
        const triangle_pair pair = stream.next();
        const triangle_contact found = tf::intersect(pair.a, pair.b);
        const unsigned control = _mm_getcsr();
        _mm_setcsr(control | 0x8040U);  // flush results, take operands for zero
        const triangle_contact flushed = tf::intersect(pair.a, pair.b);
        _mm_setcsr(control);
        REQUIRE(same_class(flushed, found));
        REQUIRE(ends_of(flushed) == ends_of(found));
    }
}
#endif
