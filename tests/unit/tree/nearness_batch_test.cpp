#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness_batch.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace {

using point = std::array<double, 3>;

double squared_distance(const point& a, const point& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/// Points in clusters, some of them equal.
std::vector<point> clustered(std::size_t count, std::uint64_t seed) {
    test::random source(seed);
    std::vector<point> points(count);
    for (point& p : points) {
        const double cluster = static_cast<double>(source.below(4));
        for (double& x : p) x = cluster + 0.01 * static_cast<double>(source.below(20));
    }
    return points;
}

struct scene {
    std::vector<point> points = clustered(800, 1);
    std::vector<point> queries = clustered(1500, 2);
    tf::tree<3> tree = tf::build(points, [](const point& p) { return tf::aabb<double, 3>{p, p}; });
    double operator()(std::size_t query, std::uint32_t id) const {
        return squared_distance(points[id], queries[query]);
    }
};

}  // namespace

TEST_CASE("nearness batch: every answer is that of a single search, on any number of threads") {
    const scene in;
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        const double radius = 0.05;
        const auto nearest = tf::nearest_batch(in.tree, in.queries, in, radius);
        const auto several = tf::k_nearest_batch(in.tree, in.queries, 6, in);
        const auto inside = tf::all_within_batch(in.tree, in.queries, 0.03, in);
        REQUIRE(nearest.size() == in.queries.size());
        REQUIRE(several.size() == in.queries.size());
        REQUIRE(inside.size() == in.queries.size());
        for (std::size_t i = 0; i < in.queries.size(); ++i) {
            const auto from = [&](std::uint32_t id) { return in(i, id); };
            REQUIRE(nearest[i] == tf::nearest(in.tree, in.queries[i], from, radius));
            REQUIRE(std::ranges::equal(several[i], tf::k_nearest(in.tree, in.queries[i], 6, from)));
            REQUIRE(
                std::ranges::equal(inside[i], tf::all_within(in.tree, in.queries[i], 0.03, from)));
        }
    }
}

TEST_CASE("nearness batch: no queries have no answers, and an empty tree has none for any") {
    const scene in;
    const std::vector<point> none;
    CHECK(tf::nearest_batch(in.tree, none, in).empty());
    CHECK(tf::k_nearest_batch(in.tree, none, 2, in).size() == 0);
    const auto empty = tf::build(none, [](const point& p) { return tf::aabb<double, 3>{p, p}; });
    for (const auto& one : tf::nearest_batch(empty, in.queries, in)) CHECK(!one);
    CHECK(tf::k_nearest_batch(empty, in.queries, 2, in).answers.empty());
}

TEST_CASE("nearness batch: the query that is not finite is named") {
    const scene in;
    std::vector<point> queries(100);
    queries[71][1] = std::numeric_limits<double>::infinity();
    queries[80][2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)tf::nearest_batch(in.tree, queries, in),
                         "treeform::nearness: query 71 is not finite, or an empty box",
                         std::invalid_argument);
}

TEST_CASE("morton order: every point is there once, and equal points keep their order") {
    for (const std::size_t count : {0U, 1U, 32U, 33U, 3000U}) {
        const std::vector<point> points = clustered(count, 5);
        const auto order =
            tf::detail::morton_order<3>(count, [&](std::size_t i) { return points[i]; });
        std::vector<std::uint32_t> sorted = order;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0U);
        CHECK(sorted == all);
        for (std::size_t i = 1; i < order.size(); ++i)
            if (points[order[i - 1]] == points[order[i]]) CHECK(order[i - 1] < order[i]);
    }
}

TEST_CASE("morton order: a walk in it is a small part of a walk in random order") {
    test::random source(9);
    std::vector<std::array<double, 2>> points(4096);
    for (auto& p : points) p = {source.in(-1e300, 1e300), source.in(-1e300, 1e300)};
    const auto order =
        tf::detail::morton_order<2>(points.size(), [&](std::size_t i) { return points[i]; });
    const auto walk = [&](const auto& number_of) {
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            for (std::size_t k = 0; k < 2; ++k)
                length += std::abs(points[number_of(i)][k] * 1e-300 -
                                   points[number_of(i - 1)][k] * 1e-300);
        return length;
    };
    CHECK(walk([&](std::size_t i) { return order[i]; }) <
          0.1 * walk([](std::size_t i) { return i; }));
}
