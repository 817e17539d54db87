#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>
#include <support/extremes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using test::boxes;
using test::infinity;
using test::squared_between;
using answers = std::vector<tf::neighbor<double>>;

template <std::size_t D>
answers neighbors_by_brute_force(const boxes<D>& of, const tf::aabb<double, D>& query,
                                 double radius = infinity) {
    answers all;
    for (std::uint32_t i = 0; i < of.size(); ++i) {
        const double squared = squared_between(of[i], query);
        if (std::sqrt(squared) <= radius) all.push_back({i, squared});
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return nearer(a, b); });
    return all;
}

answers first(answers all, std::size_t k) {
    all.resize(std::min(k, all.size()));
    return all;
}

const std::vector<tf::node_order> node_orders{
    tf::node_order::depth_first, tf::node_order::top_k_sorted, tf::node_order::best_first};

/// Those whose squared distances are doubles.
const std::vector<std::string> families{"random", "grid", "equal", "line", "far", "mixed"};

/// Queries about as large as the family's boxes, half of them points, some of them far off.
template <std::size_t D>
boxes<D> queries_for(const std::string& family, std::size_t count) {
    boxes<D> result = test::box_family<D>(family, count, 99);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 2 == 0) result[i].max = result[i].min;
        if (i % 5 == 0)
            for (std::size_t k = 0; k < D; ++k) {
                result[i].min[k] += i % 10 == 0 ? 3.0 : 1e9;
                result[i].max[k] += i % 10 == 0 ? 3.0 : 1e9;
            }
    }
    return result;
}

template <std::size_t D>
void compare_with_brute_force(const std::string& family, std::size_t count) {
    const boxes<D> of = test::box_family<D>(family, count, 7);
    const auto tree = tf::build(of, test::itself);
    std::size_t turn = 0;
    for (const tf::aabb<double, D>& query : queries_for<D>(family, 30)) {
        const auto distance_of = [&](std::uint32_t id) { return squared_between(of[id], query); };
        const answers all = neighbors_by_brute_force(of, query);
        const double radius = all.empty() ? 1.0 : std::sqrt(all[all.size() / 2].answer);
        const tf::node_order order = node_orders[turn++ % node_orders.size()];
        const auto one = tf::nearest(tree, query, distance_of, tf::unlimited_radius, order);
        REQUIRE(one.has_value() == !all.empty());
        if (one) REQUIRE(*one == all[0]);
        for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{40}, count + 1})
            REQUIRE(tf::k_nearest(tree, query, k, distance_of, tf::unlimited_radius, order) ==
                    first(all, k));
        const answers inside = neighbors_by_brute_force(of, query, radius);
        REQUIRE(tf::all_within(tree, query, radius, distance_of, order) == inside);
        REQUIRE(tf::k_nearest(tree, query, 9, distance_of, radius, order) == first(inside, 9));
    }
}

tf::aabb<double, 2> point_2(double x, double y) { return {{x, y}, {x, y}}; }

}  // namespace

TEST_CASE("nearness: nothing is near in an empty tree") {
    const boxes<3> none;
    const auto tree = tf::build(none, test::itself);
    const auto never = [](std::uint32_t) -> double { throw std::logic_error("asked"); };
    const std::array<double, 3> query{};
    CHECK(!tf::nearest(tree, query, never));
    CHECK(tf::k_nearest(tree, query, 3, never).empty());
    CHECK(tf::all_within(tree, query, infinity, never).empty());
}

TEST_CASE("nearness: the only primitive is the nearest from anywhere") {
    const boxes<3> one{test::box_at<3>({1, 2, 3}, 1.0)};
    const auto tree = tf::build(one, test::itself);
    for (const double x : {0.0, 1.5, -1e9, 1e30, 1e150}) {
        const std::array<double, 3> query{x, x, -x};
        const auto found = tf::nearest(tree, query, [](std::uint32_t) { return 17.0; });
        REQUIRE(found);
        CHECK(found->id == 0);
        CHECK(found->squared_distance() == 17.0);
    }
}

TEST_CASE("nearness: no primitive is asked about when none are wanted") {
    const boxes<2> one{point_2(0, 0)};
    const auto tree = tf::build(one, test::itself);
    const auto never = [](std::uint32_t) -> double { throw std::logic_error("asked"); };
    CHECK(tf::k_nearest(tree, std::array<double, 2>{}, 0, never).empty());
}

TEST_CASE("nearness: the radius is inclusive") {
    const boxes<2> two{point_2(3, 4), point_2(6, 8)};
    const auto tree = tf::build(two, test::itself);
    const tf::aabb<double, 2> query = point_2(0, 0);
    const auto distance_of = [&](std::uint32_t id) { return squared_between(two[id], query); };
    const auto found = [&](double radius) {
        const std::size_t count = tf::all_within(tree, query, radius, distance_of).size();
        CHECK(tf::k_nearest(tree, query, 2, distance_of, radius).size() == count);
        CHECK(tf::nearest(tree, query, distance_of, radius).has_value() == (count > 0));
        return count;
    };
    CHECK(found(std::nextafter(5.0, 0.0)) == 0);
    CHECK(found(5.0) == 1);
    CHECK(found(std::nextafter(10.0, 0.0)) == 1);
    CHECK(found(10.0) == 2);
    CHECK(found(infinity) == 2);
}

TEST_CASE("nearness: of equally near primitives the lowest comes first") {
    boxes<3> same(300, test::box_at<3>({1, 1, 1}, 0.0));
    same[0] = same[1] = test::box_at<3>({9, 9, 9}, 0.0);
    const auto tree = tf::build(same, test::itself);
    const tf::aabb<double, 3> query = test::box_at<3>({0, 0, 0}, 0.5);
    const auto distance_of = [&](std::uint32_t id) { return squared_between(same[id], query); };
    for (const tf::node_order order : node_orders) {
        CHECK(tf::nearest(tree, query, distance_of, tf::unlimited_radius, order)->id == 2);
        const auto some = tf::k_nearest(tree, query, 20, distance_of, tf::unlimited_radius, order);
        for (std::uint32_t i = 0; i < 20; ++i) CHECK(some[i].id == i + 2);
    }
}

TEST_CASE("nearness: an answer carries what the caller's function returned") {
    struct found_point {
        float squared_distance;
        std::array<float, 2> point;
    };
    const std::vector<std::array<float, 2>> points{{0, 0}, {2, 0}, {5, 5}};
    const auto tree = tf::build(points, [](const std::array<float, 2>& p) {
        return tf::aabb<float, 2>{p, p};
    });
    const std::array<float, 2> query{3, 0};
    const auto nearest = tf::nearest(tree, query, [&](std::uint32_t id) {
        const float x = points[id][0] - query[0];
        const float y = points[id][1] - query[1];
        return found_point{x * x + y * y, points[id]};
    });
    REQUIRE(nearest);
    CHECK(nearest->id == 1);
    CHECK(nearest->answer.point == points[1]);
    CHECK(nearest->squared_distance() == 1.0);
}

TEST_CASE("nearness: a distance that is NaN is no answer") {
    const boxes<2> two{point_2(0, 0), point_2(1, 0)};
    const auto tree = tf::build(two, test::itself);
    const auto distance_of = [](std::uint32_t id) {
        return id == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    };
    const std::array<double, 2> query{};
    CHECK(tf::nearest(tree, query, distance_of)->id == 1);
    CHECK(tf::k_nearest(tree, query, 2, distance_of).size() == 1);
    CHECK(tf::all_within(tree, query, infinity, distance_of).size() == 1);
}

TEST_CASE("nearness: queries and radii that cannot be meant are refused") {
    const boxes<2> one{point_2(0, 0)};
    const auto tree = tf::build(one, test::itself);
    const auto zero = [](std::uint32_t) { return 0.0; };
    using query = std::array<double, 2>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::nearest(tree, query{nan, 0}, zero), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::nearest(tree, query{0, infinity}, zero), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::nearest(tree, tf::aabb<double, 2>{}, zero), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::nearest(tree, query{}, zero, -1.0), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::all_within(tree, query{}, nan, zero), std::invalid_argument);
}

TEST_CASE("nearness: one, k and all within agree with brute force, whatever the order") {
    for (const std::string& family : families) {
        CAPTURE(family);
        for (const std::size_t count : {2U, 8U, 9U, 65U, 700U}) {
            CAPTURE(count);
            compare_with_brute_force<2>(family, count);
            compare_with_brute_force<3>(family, count);
        }
    }
}

TEST_CASE("nearness: nothing within reach is skipped at the ends of the range of double") {
    for (const std::string family : {"tiny", "huge", "extreme"}) {
        CAPTURE(family);
        const boxes<3> of = test::box_family<3>(family, 200, 3);
        const auto tree = tf::build(of, test::itself);
        // As every distance is said to be zero or infinite, what is asked about is what is near.
        for (std::uint32_t i = 0; i < of.size(); ++i) {
            std::vector<bool> seen(of.size());
            tf::visit_near(tree, of[i], [&](std::uint32_t id) {
                seen[id] = true;
                return 0.0;
            });
            for (std::uint32_t j = 0; j < of.size(); ++j)
                if (overlaps(of[i], of[j])) REQUIRE(seen[j]);
        }
    }
}
