#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/ray.hpp>

#include <doctest/doctest.h>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

using test::box;
using test::moved;
using test::triangle_of;

struct expected {
    std::optional<tf::sweep_contact> first;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
};

expected by_brute_force(const tf::mesh& a, const tf::mesh& b, const tf::point3& d) {
    expected best;
    for (std::uint32_t i = 0; i < a.faces.size(); ++i)
        for (std::uint32_t j = 0; j < b.faces.size(); ++j) {
            const auto one = tf::first_contact(triangle_of(a, i), triangle_of(b, j), d);
            if (!one) continue;
            const int order = best.first ? tf::compare(d, *one, *best.first) : -1;
            if (order > 0) continue;
            if (order < 0) best.pairs.clear();
            if (order < 0) best.first = one;
            best.pairs.emplace_back(i, j);
        }
    return best;
}

void check_impact(const tf::mesh& a, const tf::mesh& b, const tf::point3& d) {
    const auto ours = tf::time_of_impact(a, b, d, {.limit = 1'000'000});
    if (tf::intersects(a, b)) {
        CHECK(ours.outcome == tf::placement_outcome::starts_touching);
        return;
    }
    const expected truth = by_brute_force(a, b, d);
    REQUIRE((ours.outcome == tf::placement_outcome::contact) == truth.first.has_value());
    if (!truth.first) return;
    REQUIRE(ours.contacts.size() == truth.pairs.size());
    CHECK(ours.contact_count == truth.pairs.size());
    for (std::size_t i = 0; i < truth.pairs.size(); ++i)
        CHECK(std::pair(ours.contacts[i].face_a, ours.contacts[i].face_b) == truth.pairs[i]);
    CHECK(tf::compare_cut(truth.first->from, d, truth.first->until, ours.time) >= 0);
    CHECK(tf::compare_cut(truth.first->from, d, truth.first->until,
                          std::nextafter(ours.time, std::numeric_limits<double>::infinity())) < 0);
    const auto swapped = tf::time_of_impact(b, a, {-d.x, -d.y, -d.z});
    CHECK(swapped.time == ours.time);
    CHECK(swapped.contact_count == ours.contact_count);
}

}  // namespace

TEST_CASE("time of impact: a box falls flat on another, on every pair of faces that share area") {
    const tf::mesh floor = box(4, 4, 1);
    const auto found = tf::time_of_impact(moved(box(1, 1, 1), {1, 1, 5.5}), floor, {0, 0, -1});
    CHECK(found.outcome == tf::placement_outcome::contact);
    CHECK(found.time == 4.5);
    for (const tf::face_contact& c : found.contacts) CHECK(c.point.z == 1.0);
    CHECK(found.contact_count >= 2);
    // twice as fast, half the time; and not when the way is shorter
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {1, 1, 5.5}), floor, {0, 0, -2}).time == 2.25);
    const auto short_of = tf::time_of_impact(moved(box(1, 1, 1), {1, 1, 5.5}), floor, {0, 0, -1},
                                             {.latest = std::nextafter(4.5, 0.0)});
    CHECK(short_of.outcome == tf::placement_outcome::nothing_met);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {1, 1, 5.5}), floor, {0, 0, -1}, {.latest = 4.5})
              .outcome == tf::placement_outcome::contact);
}

TEST_CASE("time of impact: what only grazes has a contact, what passes by an ulp has none") {
    const tf::mesh still = box(1, 1, 1);
    const double low = std::nextafter(1.0, 2.0);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {-3, 1, 0}), still, {1, 0, 0}).time == 2.0);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {-3, low, 0}), still, {1, 0, 0}).outcome ==
          tf::placement_outcome::nothing_met);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {-3, 1, 1}), still, {1, 0, 0}).time == 2.0);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {1, 0, 0}), still, {1, 0, 0}).outcome ==
          tf::placement_outcome::starts_touching);
    CHECK(tf::time_of_impact(moved(box(1, 1, 1), {2, 0, 0}), still, {1, 0, 0}).outcome ==
          tf::placement_outcome::nothing_met);
}

TEST_CASE("time of impact: a mesh inside another runs to its wall") {
    const auto found =
        tf::time_of_impact(moved(box(1, 1, 1), {2, 2, 2}), box(10, 10, 10), {0.25, 0, 0});
    CHECK(found.time == 28.0);
}

TEST_CASE("time of impact is that of all pairs of faces, also where times are equal") {
    test::random source(5);
    for (int round = 0; round < 60; ++round) {
        const bool lattice = round % 2 == 0;
        const auto soup = [&] {
            return lattice ? test::lattice_soup(source, 30, 20, 4)
                           : test::random_soup(source, 40, 0.2);
        };
        const double away = lattice ? 5.0 : 2.0;
        const tf::point3 offset{source.below(2) ? -away : 0.0, source.below(2) ? away : 0.0, -away};
        const tf::point3 d =
            lattice ? tf::point3{static_cast<double>(source.below(3)) - (offset.x == 0.0 ? 1 : 0),
                                 -static_cast<double>(source.below(3)), 1.0}
                    : tf::point3{-offset.x + source.in(-0.5, 0.5), -offset.y, away};
        check_impact(moved(soup(), offset), soup(), d);
    }
}

TEST_CASE(
    "time of impact: times and pairs do not change with scale, and hold far from the origin") {
    test::random source(8);
    const tf::mesh a = moved(test::random_soup(source, 60, 0.3), {0, 0, 3});
    const tf::mesh b = test::random_soup(source, 60, 0.3);
    const tf::point3 d{0.1, -0.2, -1};
    const auto plain = tf::time_of_impact(a, b, d);
    REQUIRE(plain.outcome == tf::placement_outcome::contact);
    for (const double scale : {0x1p-300, 0x1p-40, 0x1p40, 0x1p300}) {
        const auto scaled = [&](tf::mesh mesh) {
            for (tf::point3& p : mesh.points)
                for (std::size_t k = 0; k < 3; ++k) p[k] *= scale;
            return mesh;
        };
        const auto found = tf::time_of_impact(scaled(a), scaled(b), d);
        CHECK(found.time == plain.time * scale);
        CHECK(found.contact_count == plain.contact_count);
        const auto together =
            tf::time_of_impact(scaled(a), scaled(b), {d.x * scale, d.y * scale, d.z * scale});
        CHECK(together.time == plain.time);
    }
    check_impact(moved(a, {1e9, -1e9, 1e9}), moved(b, {1e9, -1e9, 1e9}), d);
}

TEST_CASE(
    "time of impact: swapping the meshes and turning the motion changes no time and no pair") {
    test::random source(12);
    int met = 0;
    for (int round = 0; round < 40; ++round) {
        const tf::mesh a = test::random_soup(source, 20, 0.5);
        const tf::mesh b = moved(test::random_soup(source, 25, 0.5), {0.2, 0.1, 3.0});
        const tf::point3 d{source.in(-0.2, 0.2), source.in(-0.2, 0.2), 1.0};
        const auto one = tf::time_of_impact(a, b, d);
        const auto other = tf::time_of_impact(b, a, {-d.x, -d.y, -d.z});
        REQUIRE(one.outcome == other.outcome);
        CHECK(one.time == other.time);
        CHECK(one.contact_count == other.contact_count);
        if (one.contact_count != 1) continue;
        ++met;
        CHECK(one.contacts[0].face_a == other.contacts[0].face_b);
        CHECK(one.contacts[0].face_b == other.contacts[0].face_a);
    }
    CHECK(met > 10);
}

TEST_CASE("time of impact: moved meshes are taken where their transforms put them") {
    test::random source(9);
    const tf::mesh a = test::random_soup(source, 50, 0.3);
    const tf::mesh b = test::random_soup(source, 50, 0.3);
    tf::transform<3> turn;
    turn.rows = {{{0.6, -0.8, 0, 0.1}, {0.8, 0.6, 0, 0.2}, {0, 0, 1, 4}}};
    tf::mesh turned = a;
    for (tf::point3& p : turned.points) p = turn(p);
    const auto expected = tf::time_of_impact(turned, b, {0, 0, -1});
    const auto found = tf::time_of_impact(a, b, {0, 0, -1}, {.transform_a = turn});
    CHECK(found.time == expected.time);
    CHECK(found.contacts == expected.contacts);
    const auto other = tf::time_of_impact(b, a, {0, 0, 1}, {.transform_b = turn});
    CHECK(other.time == expected.time);
}

TEST_CASE("time of impact: motions and times that cannot be meant are refused") {
    const tf::mesh a = moved(box(1, 1, 1), {0, 0, 3}), b = box(1, 1, 1);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(static_cast<void>(tf::time_of_impact(a, b, {0, 0, 0})), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::time_of_impact(a, b, {0, nan, 0})),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::time_of_impact(a, b, {0, 0, 1}, {.latest = -1.0})),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(tf::time_of_impact(a, b, {0, 0, 1}, {.latest = nan})),
                    std::invalid_argument);
    CHECK(tf::time_of_impact(tf::mesh{}, b, {0, 0, 1}).outcome ==
          tf::placement_outcome::nothing_met);
}

TEST_CASE("a sweep visits every pair of boxes that meet within the time, once") {
    test::random source(12);
    for (int round = 0; round < 20; ++round) {
        std::vector<tf::aabb<double, 3>> a, b;
        const auto fill = [&](std::vector<tf::aabb<double, 3>>& boxes, double z) {
            for (int i = 0; i < 100; ++i) {
                const tf::point3 at{source.unit(), source.unit(), source.unit() + z};
                tf::aabb<double, 3> one;
                one.include(at);
                one.include(tf::point3{at.x + 0.1 * source.unit(), at.y, at.z + 0.1});
                boxes.push_back(one);
            }
        };
        fill(a, 2.0);
        fill(b, 0.0);
        const auto self = [](const tf::aabb<double, 3>& one) { return one; };
        const tf::tree<3> tree_a = tf::build(a, self), tree_b = tf::build(b, self);
        const tf::point3 d{round % 3 == 0 ? 0.0 : source.in(-0.3, 0.3), source.in(-0.3, 0.3), -1.0};
        constexpr double latest = 2.0;
        std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
        tf::visit_swept(
            tree_a, tree_b, d,
            [&](std::uint32_t i, std::uint32_t j) {
                CHECK(seen.emplace(i, j).second);
                return latest;
            },
            latest);
        std::size_t missed = 0, meeting = 0;
        for (std::uint32_t i = 0; i < a.size(); ++i)
            for (std::uint32_t j = 0; j < b.size(); ++j) {
                double from = 0.0, to = latest;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double low = b[j].min[k] - a[i].max[k], high = b[j].max[k] - a[i].min[k];
                    if (d[k] == 0.0) {
                        if (low > 0.0 || high < 0.0) to = -1.0;
                        continue;
                    }
                    from = std::max(from, (d[k] > 0 ? low : high) / d[k]);
                    to = std::min(to, (d[k] > 0 ? high : low) / d[k]);
                }
                if (from > to) continue;
                ++meeting;
                missed += !seen.contains({i, j});
            }
        CHECK(missed == 0);
        CHECK(meeting > 0);
        CHECK(seen.size() < a.size() * b.size() / 2);
    }
}
