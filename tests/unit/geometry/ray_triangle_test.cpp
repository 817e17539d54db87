#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

using whole = std::int64_t;
using vec = std::array<whole, 3>;

vec minus(const vec& a, const vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
vec times(const vec& a, whole f) { return {a[0] * f, a[1] * f, a[2] * f}; }
vec sum_of(const vec& a, const vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
whole dot(const vec& a, const vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
vec cross(const vec& a, const vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// num / den, den >= 0; 1 / 0 and -1 / 0 are infinite.
struct ratio {
    whole num, den;
    friend bool operator<(const ratio& a, const ratio& b) {
        if (a.den == 0 && b.den == 0) return a.num < b.num;
        return a.num * b.den < b.num * a.den;
    }
    [[nodiscard]] double value() const {
        return static_cast<double>(num) / static_cast<double>(den);
    }
};

/// A ray and a triangle of small whole numbers, and the definition of what they share: the ray cut
/// down by the half-spaces that make up the triangle.
struct subject {
    vec origin, direction;
    ratio t_min{0, 1};
    ratio t_max{1, 0};
    std::array<vec, 3> corners;

    struct answer {
        ratio line_entry, entry, exit;
        tf::triangle_feature at;
        bool coplanar;
    };

    [[nodiscard]] std::optional<answer> expected() const {
        ratio begin{-1, 0}, end{1, 0};
        bool empty = false;
        const auto not_negative = [&](const vec& n, const vec& at) {  // n . (x - at) >= 0
            const whole a = dot(n, minus(origin, at));
            const whole b = dot(n, direction);
            if (b == 0) {
                empty |= a < 0;
            } else if (b > 0) {
                begin = std::max(begin, ratio{-a, b});
            } else {
                end = std::min(end, ratio{a, -b});
            }
        };
        const auto zero = [&](const vec& n, const vec& at) {
            not_negative(n, at);
            not_negative(times(n, -1), at);
        };
        const vec n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
        if (n != vec{}) {
            zero(n, corners[0]);
            for (std::size_t i = 0; i < 3; ++i)
                not_negative(cross(n, minus(corners[(i + 1) % 3], corners[i])), corners[i]);
        } else {
            const vec along = minus(*high, *low);
            for (const vec& axis : {vec{1, 0, 0}, vec{0, 1, 0}, vec{0, 0, 1}})
                zero(along == vec{} ? axis : cross(along, axis), *low);
            not_negative(along, *low);
            not_negative(times(along, -1), *high);
        }
        const ratio entry = std::max(begin, t_min);
        const ratio exit = std::min(end, t_max);
        if (empty || exit < entry) return std::nullopt;
        return answer{begin, entry, exit, name_of(entry), dot(n, direction) == 0};
    }

    [[nodiscard]] tf::triangle_feature name_of(const ratio& t) const {
        const vec x = sum_of(times(origin, t.den), times(direction, t.num));
        const auto corner = [&](std::size_t i) { return times(corners[i % 3], t.den); };
        for (std::size_t i = 0; i < 3; ++i)
            if (x == corner(i)) return static_cast<tf::triangle_feature>(i);
        for (std::size_t i = 0; i < 3; ++i) {
            const vec to_from = minus(corner(i), x);
            const vec to_next = minus(corner(i + 1), x);
            if (cross(to_from, to_next) == vec{} && dot(to_from, to_next) < 0)
                return static_cast<tf::triangle_feature>(3 + i);
        }
        return tf::triangle_feature::interior;
    }
};

vec small(test::random& random, std::size_t reach) {
    vec v;
    for (whole& x : v)
        x = static_cast<whole>(random.below(2 * reach + 1)) - static_cast<whole>(reach);
    return v;
}

subject any_subject(test::random& random) {
    subject s;
    const std::size_t reach = 1 + random.below(4);
    for (vec& c : s.corners) c = small(random, reach);
    if (random.below(8) == 0) s.corners[2] = s.corners[random.below(2)];
    s.origin = small(random, reach + 1);
    if (random.below(3) == 0) s.corners[0][2] = s.corners[1][2] = s.corners[2][2] = s.origin[2];
    do s.direction = small(random, random.below(2) == 0 ? 1 : 4);
    while (s.direction == vec{});
    if (random.below(2) == 0) {  // aimed at a point of the triangle
        const whole i = static_cast<whole>(random.below(4));
        const whole j = static_cast<whole>(random.below(static_cast<std::size_t>(5 - i)));
        const vec aim = sum_of(sum_of(times(s.corners[0], i), times(s.corners[1], j)),
                               times(s.corners[2], 4 - i - j));
        s.direction = minus(aim, times(s.origin, 4));
        if (s.direction == vec{}) s.direction = {1, 0, 0};
    }
    const auto limit = [&] { return static_cast<whole>(random.below(9)) - 4; };
    if (random.below(3) == 0) s.t_min = {limit(), random.below(2) == 0 ? 1 : 4};
    if (random.below(6) == 0) s.t_min = {-1, 0};
    if (random.below(3) == 0) s.t_max = {limit(), random.below(2) == 0 ? 1 : 4};
    return s;
}

/// Where the numbers of a subject go: exact steps all of them.
struct placement {
    double scale = 1.0;
    double offset = 0.0;
    double length = 1.0;  ///< of directions; t shrinks by as much

    [[nodiscard]] tf::point3 point(const vec& v) const {
        const auto at = [&](std::size_t k) { return (static_cast<double>(v[k]) + offset) * scale; };
        return {at(0), at(1), at(2)};
    }
    [[nodiscard]] tf::triangle3 triangle(const subject& s) const {
        return {point(s.corners[0]), point(s.corners[1]), point(s.corners[2])};
    }
    [[nodiscard]] tf::ray3 ray(const subject& s) const {
        tf::ray3 r;
        const tf::point3 origin = point(s.origin);
        for (std::size_t k = 0; k < 3; ++k) {
            r.origin[k] = origin[k];
            r.direction[k] = static_cast<double>(s.direction[k]) * scale * length;
        }
        r.t_min = s.t_min.value() / length;
        r.t_max = s.t_max.value() / length;
        return r;
    }
};

const std::vector<placement> placements = {
    {},
    {1.0, 1e6, 1.0},
    {0x1p-20, 0x1p+40, 0x1p+10},
    {0x1p-1060, 0.0, 1.0},
    {0x1p+1000, 0.0, 0x1p-30},
    {0x1p-300, 0x1p+20, 0x1p+500},
    {0x1p+200, 1.0, 0x1p-700},
};

bool is_close(double t, double exact) { return std::abs(t - exact) <= 0x1p-40 * std::abs(exact); }

TEST_CASE("ray and triangle: the first common point is that of the definition, by name") {
    test::random random(11);
    std::array<int, 7> seen{};
    int coplanar = 0, from_start = 0, missed = 0;
    for (int i = 0; i < 60000; ++i) {
        CAPTURE(i);
        const subject s = any_subject(random);
        const placement& place = placements[static_cast<std::size_t>(i) % placements.size()];
        const auto expected = s.expected();
        const auto found = tf::intersect(place.ray(s), place.triangle(s));
        REQUIRE(found.has_value() == expected.has_value());
        missed += !found;
        if (!found) continue;
        CHECK(found->at == expected->at);
        CHECK(found->coplanar == expected->coplanar);
        if (found->from_start) CHECK(expected->line_entry < expected->entry);
        CHECK(is_close(found->t * place.length, expected->entry.value()));
        if (expected->exit.den != 0)
            CHECK(is_close(found->t_end * place.length, expected->exit.value()));
        ++seen[static_cast<std::size_t>(found->at)];
        coplanar += found->coplanar;
        from_start += found->from_start;
    }
    for (const int count : seen) CHECK(count > 500);
    CHECK(coplanar > 500);
    CHECK(from_start > 100);
    CHECK(missed > 5000);
}

TEST_CASE("ray and triangle: contacts are ordered as the exact parameters are") {
    test::random random(12);
    std::array<int, 3> seen{};
    for (int i = 0; i < 60000; ++i) {
        CAPTURE(i);
        subject a = any_subject(random);
        subject b = a;
        b.corners = any_subject(random).corners;
        if (random.below(2) == 0) b.corners[random.below(3)] = a.corners[random.below(3)];
        const placement& place = placements[static_cast<std::size_t>(i) % placements.size()];
        const tf::ray3 ray = place.ray(a);
        const auto of_a = a.expected(), of_b = b.expected();
        if (!of_a || !of_b) continue;
        const int order = of_a->entry < of_b->entry ? -1 : of_b->entry < of_a->entry;
        const auto first = tf::intersect(ray, place.triangle(a));
        const auto second = tf::intersect(ray, place.triangle(b));
        CHECK(tf::compare(ray, *first, *second) == order);
        CHECK(tf::compare(ray, *second, *first) == -order);
        ++seen[static_cast<std::size_t>(order + 1)];
    }
    for (const int count : seen) CHECK(count > 300);
}

TEST_CASE("ray and triangle: parameters one part in 2^60 apart are told apart") {
    const tf::ray3 ray{{-1, 0, 0}, {1, 0, 0}};
    // Planes x = h y + e z: both meet the axis at x = 0 exactly, except for what is added.
    const auto wall = [](double x0, double slope) {
        return tf::triangle3{tf::point3{x0 - slope, -1, -1}, {x0 + slope, 1, -1}, {x0, 0, 2}};
    };
    const auto at = [&](const tf::triangle3& t) { return *tf::intersect(ray, t); };
    CHECK(tf::compare(ray, at(wall(0, 0.3)), at(wall(0, 0.1))) == 0);
    CHECK(tf::compare(ray, at(wall(0x1p-60, 0)), at(wall(0, 0.1))) == 1);
    CHECK(tf::compare(ray, at(wall(0, 0.25)), at(wall(0x1p-60, 0))) == -1);
    CHECK(tf::compare(ray, at(wall(0x1p-1074, 0)), at(wall(0, 0.75))) == 1);
}

TEST_CASE("ray and triangle: two triangles with a common edge leave no gap between them") {
    test::random random(13);
    int edge = 0;
    for (int i = 0; i < 20000; ++i) {
        // A quad around the z axis, cut along its diagonal; rays at points of the diagonal, which
        // are exact for every other one, and rounded off it for the rest.
        const bool exact = i % 2 == 0;
        const auto unit = [&] {
            return exact ? std::floor(random.unit() * 0x1p20) * 0x1p-20 : random.unit();
        };
        const auto coordinate = [&] { return 2.0 * unit() - 1.0; };
        const tf::point3 p{-1 - unit(), -unit(), coordinate()};
        const tf::point3 q{1 + unit(), -unit(), coordinate()};
        const tf::point3 r{1 + unit(), 2 + unit(), coordinate()};
        const tf::point3 s{-1 - unit(), 2 + unit(), coordinate()};
        const double f = exact ? (1.0 + static_cast<double>(random.below(15))) / 16.0 : unit();
        const tf::point3 aim{p.x + f * (r.x - p.x), p.y + f * (r.y - p.y), p.z + f * (r.z - p.z)};
        tf::ray3 ray{{coordinate(), coordinate(), 5 + unit()}};
        ray.direction = {aim.x - ray.origin[0], aim.y - ray.origin[1], aim.z - ray.origin[2]};
        const auto one = tf::intersect(ray, {p, q, r});
        const auto other = tf::intersect(ray, {r, s, p});
        if (f > 0.01 && f < 0.99) REQUIRE((one || other));
        CHECK((one && other) >= exact);
        if (one && other) {
            CHECK(one->at == tf::triangle_feature::e2);
            CHECK(other->at == tf::triangle_feature::e2);
            CHECK(tf::compare(ray, *one, *other) == 0);
            ++edge;
        }
    }
    CHECK(edge >= 10000);
}

TEST_CASE("ray and triangle: an empty range and one of a single parameter") {
    const tf::triangle3 t{tf::point3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto hits = [&](double t_min, double t_max) {
        return tf::intersect({{0.25, 0.25, -3}, {0, 0, 1}, t_min, t_max}, t).has_value();
    };
    CHECK(hits(3, 3));
    CHECK_FALSE(hits(4, 2));
    CHECK_FALSE(hits(0, std::nextafter(3.0, 0.0)));
    CHECK_FALSE(hits(std::nextafter(3.0, 4.0), infinite));
    CHECK(hits(-infinite, infinite));
}

}  // namespace
