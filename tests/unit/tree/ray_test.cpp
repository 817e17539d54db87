#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/ray.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace {

using test::itself;

constexpr double infinite = std::numeric_limits<double>::infinity();

template <std::size_t D>
using ray_box = tf::aabb<double, D>;

/// A ray and boxes of small whole numbers, and whether they meet in exact arithmetic.
template <std::size_t D>
struct whole_ray {
    std::array<std::int64_t, D> origin, direction;
    std::int64_t t_min = 0;
    std::int64_t t_max = 1'000'000;  ///< in place of infinity
};

/// num / den with den > 0.
struct ratio {
    std::int64_t num, den;
    friend bool operator<=(const ratio& a, const ratio& b) {
        return a.num * b.den <= b.num * a.den;
    }
};

template <std::size_t D>
bool meets(const whole_ray<D>& r, const ray_box<D>& b) {
    ratio near{r.t_min, 1};
    ratio far{r.t_max, 1};
    for (std::size_t k = 0; k < D; ++k) {
        const auto low = static_cast<std::int64_t>(b.min[k]) - r.origin[k];
        const auto high = static_cast<std::int64_t>(b.max[k]) - r.origin[k];
        const std::int64_t d = r.direction[k];
        if (d == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const ratio from = d > 0 ? ratio{low, d} : ratio{-high, -d};
        const ratio to = d > 0 ? ratio{high, d} : ratio{-low, -d};
        if (near <= from) near = from;
        if (to <= far) far = to;
    }
    return near <= far;
}

/// Boxes and ray moved by `offset` and scaled by a power of two; nothing is rounded.
template <std::size_t D>
tf::ray<double, D> placed(const whole_ray<D>& r, double offset, double scale, double length) {
    tf::ray<double, D> result;
    for (std::size_t k = 0; k < D; ++k) {
        result.origin[k] = (static_cast<double>(r.origin[k]) + offset) * scale;
        result.direction[k] = static_cast<double>(r.direction[k]) * scale * length;
        if (r.direction[k] == 0 && r.origin[k] % 2 != 0) result.direction[k] = -0.0;
    }
    result.t_min = static_cast<double>(r.t_min) / length;
    result.t_max = r.t_max == 1'000'000 ? infinite : static_cast<double>(r.t_max) / length;
    return result;
}

template <std::size_t D>
std::vector<ray_box<D>> placed(std::vector<ray_box<D>> boxes, double offset, double scale) {
    for (ray_box<D>& b : boxes)
        for (std::size_t k = 0; k < D; ++k) {
            b.min[k] = (b.min[k] + offset) * scale;
            b.max[k] = (b.max[k] + offset) * scale;
        }
    return boxes;
}

template <std::size_t D>
std::vector<ray_box<D>> whole_boxes(test::random& random, std::size_t count, std::size_t side) {
    std::vector<ray_box<D>> boxes(count);
    for (ray_box<D>& b : boxes)
        for (std::size_t k = 0; k < D; ++k) {
            b.min[k] = static_cast<double>(random.below(side));
            b.max[k] = b.min[k] + static_cast<double>(random.below(3));  // flat ones, too
        }
    return boxes;
}

template <std::size_t D>
whole_ray<D> any_whole_ray(test::random& random, std::size_t side) {
    whole_ray<D> r;
    const auto around = [&](std::size_t reach) {
        return static_cast<std::int64_t>(random.below(2 * reach + 1)) -
               static_cast<std::int64_t>(reach);
    };
    for (std::size_t k = 0; k < D; ++k) {
        r.origin[k] = around(2 * side);
        r.direction[k] = random.below(3) == 0 ? 0 : around(random.below(2) == 0 ? 2 : 100);
    }
    if (random.below(2) == 0)  // at a lattice point among the boxes
        for (std::size_t k = 0; k < D; ++k)
            r.direction[k] = static_cast<std::int64_t>(random.below(side)) - r.origin[k];
    if (random.below(3) == 0) r.t_min = around(10);
    if (random.below(3) == 0) r.t_max = r.t_min + static_cast<std::int64_t>(random.below(10));
    return r;
}

template <std::size_t D>
std::vector<std::uint32_t> visited(const tf::tree<D>& tree, const tf::ray<double, D>& ray) {
    std::vector<std::uint32_t> ids;
    tf::visit_ray(tree, ray, [&](std::uint32_t id) {
        ids.push_back(id);
        return ray.t_max;
    });
    std::sort(ids.begin(), ids.end());
    return ids;
}

template <std::size_t D>
void check_no_box_is_missed(double offset, double scale, double length) {
    test::random random(7);
    const std::size_t side = D == 2 ? 40 : 16;
    const auto boxes = whole_boxes<D>(random, 900, side);
    const auto tree = tf::build(placed(boxes, offset, scale), itself);
    std::size_t met = 0;
    std::size_t extra = 0;
    for (int i = 0; i < 300; ++i) {
        const auto whole = any_whole_ray<D>(random, side);
        const auto ids = visited(tree, placed(whole, offset, scale, length));
        REQUIRE(std::adjacent_find(ids.begin(), ids.end()) == ids.end());
        for (std::uint32_t id = 0; id < boxes.size(); ++id) {
            const bool found = std::binary_search(ids.begin(), ids.end(), id);
            const bool expected = meets(whole, boxes[id]);
            REQUIRE((found || !expected));
            met += expected;
            extra += found && !expected;
        }
    }
    CHECK(met > 500);
    CHECK(extra == 0);  // what whole numbers do not meet they miss by a good deal
}

TEST_CASE("ray: every box that the exact ray touches is visited once, and hardly any other") {
    for (const double scale : {1.0, 0x1p-30, 0x1p-500, 0x1p-1000, 0x1p+100, 0x1p+900})
        for (const double offset : {0.0, 0x1p+10, 0x1p+40})
            for (const double length : {1.0, 0x1p-20, 0x1p+60}) {
                CAPTURE(scale);
                CAPTURE(offset);
                CAPTURE(length);
                check_no_box_is_missed<2>(offset, scale, length);
                check_no_box_is_missed<3>(offset, scale, length);
            }
}

TEST_CASE("ray: denormal and extreme coordinates and directions miss nothing") {
    check_no_box_is_missed<2>(0.0, 0x1p-1074, 1.0);
    check_no_box_is_missed<3>(0.0, 0x1p-1074, 1.0);
    check_no_box_is_missed<2>(0.0, 0x1p+1010, 1.0);
    check_no_box_is_missed<3>(0.0, 0x1p+1010, 1.0);
    check_no_box_is_missed<3>(0.0, 0x1p-200, 0x1p-800);
    check_no_box_is_missed<3>(0.0, 0x1p-200, 0x1p+1000);
}

/// Boxes of size 1 to 3 at whole places from 1 to 2^20 away from the middle, where those of the
/// tree are rounded least, and rays through their corners from up to 2^20 steps away.
template <std::size_t D>
void check_corners_are_met(std::uint64_t seed) {
    test::random random(seed);
    const auto signed_below = [&](std::size_t count) {
        const auto x = static_cast<double>(random.below(count));
        return random.below(2) == 0 ? x : -x;
    };
    std::vector<ray_box<D>> boxes(500);
    for (ray_box<D>& b : boxes)
        for (std::size_t k = 0; k < D; ++k) {
            b.min[k] = signed_below(std::size_t{1} << random.below(21));
            b.max[k] = b.min[k] + 1.0 + static_cast<double>(random.below(3));
        }
    const auto tree = tf::build(boxes, itself);
    for (int i = 0; i < 2000; ++i) {
        const auto id = static_cast<std::uint32_t>(random.below(boxes.size()));
        tf::ray<double, D> r;
        const auto steps = static_cast<double>(random.below(std::size_t{1} << random.below(21)));
        for (std::size_t k = 0; k < D; ++k) {
            r.direction[k] = signed_below(std::size_t{1} << random.below(10));
            const double corner = random.below(2) == 0 ? boxes[id].min[k] : boxes[id].max[k];
            r.origin[k] = corner - steps * r.direction[k];
        }
        r.t_max = random.below(2) == 0 ? infinite : steps;
        const auto ids = visited(tree, r);
        REQUIRE(std::binary_search(ids.begin(), ids.end(), id));
    }
}

TEST_CASE("ray: a box touched at a corner only is visited") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        check_corners_are_met<2>(seed);
        check_corners_are_met<3>(seed);
    }
}

TEST_CASE("ray: an origin far away does not blur what is met") {
    std::vector<ray_box<3>> boxes;
    for (int x = 0; x < 32; ++x)
        for (int y = 0; y < 32; ++y) {
            ray_box<3> b;
            b.include(std::array{x + 0.25, y + 0.25, 0.0});
            b.include(std::array{x + 0.75, y + 0.75, 1.0});
            boxes.push_back(b);
        }
    const auto tree = tf::build(boxes, itself);
    for (const double distance : {1e3, 1e6, 1e9}) {
        const tf::ray<double, 3> down{{5.5, 7.5, distance}, {0, 0, -1}};
        CHECK(visited(tree, down) == std::vector<std::uint32_t>{5 * 32 + 7});
        const tf::ray<double, 3> aslant{{5.5 - distance, 7.5, 0.5 + distance}, {1, 0, -1}};
        CHECK(visited(tree, aslant) == std::vector<std::uint32_t>{5 * 32 + 7});
        const tf::ray<double, 3> between{{5.5, 7.0, distance}, {0, 0, -1}};
        CHECK(visited(tree, between).empty());
    }
}

TEST_CASE("ray: a component that is nearly zero is not taken for none") {
    std::vector<ray_box<2>> boxes(2);
    boxes[0].include(std::array{0.0, 0.0});
    boxes[1].include(std::array{0x1p+900, 1.0});  // reached by climbing 2^-900 a step
    const auto tree = tf::build(boxes, itself);
    const tf::ray<double, 2> slow{{0.0, 0.0}, {1.0, 0x1p-900}};
    CHECK(visited(tree, slow) == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("ray: empty trees, one box, points and empty ranges") {
    const tf::ray<double, 3> x_axis{{-1, 0, 0}, {1, 0, 0}};
    CHECK(visited(tf::build(std::vector<ray_box<3>>{}, itself), x_axis).empty());
    const auto tree = tf::build(std::vector{ray_box<3>{{0, 0, 0}, {1, 1, 1}}}, itself);
    const auto one = std::vector<std::uint32_t>{0};
    CHECK(visited(tree, x_axis) == one);  // along an edge of the box
    CHECK(visited(tree, {{-1, 0, 0}, {1, 0, 0}, 0.0, 1.0}) == one);
    CHECK(visited(tree, {{-1, 0, 0}, {1, 0, 0}, 0.0, 0.999}).empty());
    CHECK(visited(tree, {{-1, 0, 0}, {1, 0, 0}, 2.0, 3.0}) == one);
    CHECK(visited(tree, {{-1, 0, 0}, {1, 0, 0}, 2.001, 3.0}).empty());
    CHECK(visited(tree, {{-1, 0, 0}, {1, 0, 0}, 2.0, 1.0}).empty());
    CHECK(visited(tree, {{-1, 0, 0}, {-1, 0, 0}, -infinite, infinite}) == one);
    CHECK(visited(tree, {{-1, 0, 0}, {-1, 0, 0}}).empty());
    CHECK(visited(tree, {{1, 1, 1}, {0, 0, 0}}) == one);
    CHECK(visited(tree, {{1, 1, 1.001}, {0, 0, 0}}).empty());
}

TEST_CASE("ray: what is no number is refused") {
    const auto tree = tf::build(std::vector{ray_box<3>{{0, 0, 0}, {1, 1, 1}}}, itself);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto visit = [](std::uint32_t) { return 1.0; };
    CHECK_THROWS_AS(tf::visit_ray(tree, tf::ray<double, 3>{{nan, 0, 0}, {1, 0, 0}}, visit),
                    std::invalid_argument);
    CHECK_THROWS_AS(tf::visit_ray(tree, tf::ray<double, 3>{{0, 0, 0}, {infinite, 0, 0}}, visit),
                    std::invalid_argument);
    CHECK_THROWS_AS(tf::visit_ray(tree, tf::ray<double, 3>{{0, 0, 0}, {1, 0, 0}, nan}, visit),
                    std::invalid_argument);
}

/// Where a ray enters a closed disc or ball; also the definition that the tree is compared with.
template <std::size_t D>
struct round_shape {
    std::array<double, D> center;
    double radius;

    [[nodiscard]] ray_box<D> bounds() const {
        ray_box<D> b;
        for (std::size_t k = 0; k < D; ++k) {
            b.min[k] = center[k] - radius;
            b.max[k] = center[k] + radius;
        }
        return b;
    }
    [[nodiscard]] std::optional<double> hit(const tf::ray<double, D>& r) const {
        double a = 0.0, b = 0.0, c = -radius * radius;
        for (std::size_t k = 0; k < D; ++k) {
            const double from = r.origin[k] - center[k];
            a += r.direction[k] * r.direction[k];
            b += r.direction[k] * from;
            c += from * from;
        }
        const double under = b * b - a * c;
        if (under < 0.0) return std::nullopt;
        return (-b - std::sqrt(under)) / a;
    }
};

struct named_hit {
    float t;
    std::uint32_t name;
};

template <std::size_t D>
void check_against_a_loop(std::uint64_t seed) {
    test::random random(seed);
    std::vector<round_shape<D>> balls(seed % 2 == 0 ? 400 : 9);
    for (round_shape<D>& b : balls) {
        for (double& x : b.center) x = random.unit();
        b.radius = random.in(0.001, 0.1);
        if (random.below(3) == 0) b = balls[random.below(balls.size())];  // ties
    }
    const auto tree = tf::build(balls, [](const round_shape<D>& b) { return b.bounds(); });
    for (int i = 0; i < 100; ++i) {
        tf::ray<double, D> r;
        for (double& x : r.origin) x = random.in(-1, 2);
        for (double& x : r.direction) x = random.in(-3, 3);
        if (random.below(2) == 0) r.t_max = random.unit();
        if (random.below(4) == 0) r.t_min = -infinite;
        const auto hit_of = [&](std::uint32_t id) { return balls[id].hit(r); };
        std::vector<std::pair<double, std::uint32_t>> expected;
        for (std::uint32_t id = 0; id < balls.size(); ++id)
            if (const auto t = hit_of(id); t && r.t_min <= *t && *t <= r.t_max)
                expected.emplace_back(*t, id);
        std::sort(expected.begin(), expected.end());

        const auto first = tf::first_hit(tree, r, hit_of);
        REQUIRE(first.has_value() == !expected.empty());
        if (first) CHECK(first->hit == expected[0].first);
        if (first) CHECK(first->id == expected[0].second);
        CHECK(tf::any_hit(tree, r, hit_of) == !expected.empty());
        const auto all = tf::all_hits(tree, r, hit_of);
        REQUIRE(all.size() == expected.size());
        for (std::size_t j = 0; j < all.size(); ++j) {
            CHECK(all[j].hit == expected[j].first);
            CHECK(all[j].id == expected[j].second);
        }
    }
}

TEST_CASE("ray: first, all and any hit agree with a loop over all primitives") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        check_against_a_loop<2>(seed);
        check_against_a_loop<3>(seed);
    }
}

TEST_CASE("ray: a hit may be a struct, a ray of floats, and any_hit a yes or no") {
    const std::vector<round_shape<2>> balls{{{0, 0}, 1}, {{5, 0}, 1}, {{5, 0}, 1}};
    const auto tree = tf::build(balls, [](const round_shape<2>& b) { return b.bounds(); });
    const tf::ray<float, 2> r{{2, 0}, {1, 0}};
    const auto hit_of = [&](std::uint32_t id) -> std::optional<named_hit> {
        return named_hit{id == 0 ? -3.0F : 2.0F, 10 + id};
    };
    const auto hit = tf::first_hit(tree, r, hit_of);
    REQUIRE(hit);
    CHECK(hit->id == 1);
    CHECK(hit->hit.name == 11);
    CHECK(tf::all_hits(tree, r, hit_of).size() == 2);
    CHECK(tf::any_hit(tree, r, [](std::uint32_t id) { return id == 2; }));
    CHECK_FALSE(tf::any_hit(tree, r, [](std::uint32_t id) { return id == 0; }));
}

TEST_CASE("ray: the first hit is found without looking at everything behind it") {
    std::vector<ray_box<3>> boxes;
    for (int i = 0; i < 4096; ++i) {
        const double x = i;
        boxes.push_back({{x, 0, 0}, {x + 0.5, 1, 1}});
    }
    const auto tree = tf::build(boxes, itself);
    std::size_t asked = 0;
    const auto hit = tf::first_hit(tree, tf::ray<double, 3>{{-7, 0.5, 0.5}, {1, 0, 0}},
                                   [&](std::uint32_t id) -> std::optional<double> {
                                       ++asked;
                                       return 7.0 + id;
                                   });
    CHECK(hit->id == 0);
    CHECK(asked == 1);
}

}  // namespace
