#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness_pair.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using test::boxes;
using test::squared_between;
using near_pairs = std::vector<tf::neighbor<double, tf::id_pair>>;

template <std::size_t D>
near_pairs pairs_by_brute_force(const boxes<D>& a, const boxes<D>& b) {
    near_pairs all;
    for (std::uint32_t i = 0; i < a.size(); ++i)
        for (std::uint32_t j = 0; j < b.size(); ++j)
            all.push_back({{i, j}, squared_between(a[i], b[j])});
    std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return nearer(x, y); });
    return all;
}

/// Whether `found` are the first of `all`, up to which of the pairs that touch they are.
bool are_first(const near_pairs& found, const near_pairs& all, std::size_t k) {
    if (found.size() != std::min(k, all.size())) return false;
    if (!found.empty() && found.back().answer == 0.0)
        return std::all_of(found.begin(), found.end(),
                           [](const auto& pair) { return pair.answer == 0.0; }) &&
               all[found.size() - 1].answer == 0.0;
    return std::equal(found.begin(), found.end(), all.begin());
}

template <std::size_t D>
boxes<D> shifted(boxes<D> of, double x) {
    for (auto& box : of) {
        box.min[0] += x;
        box.max[0] += x;
    }
    return of;
}

template <std::size_t D>
void compare_pairs(const std::string& family, std::size_t count) {
    const boxes<D> a = test::box_family<D>(family, count, 1);
    const auto tree_a = tf::build(a, test::itself);
    for (const double x : {0.0, 0.75, -64.0}) {
        CAPTURE(x);
        const boxes<D> b = shifted(test::box_family<D>(family, count / 2 + 1, 2), x);
        const auto tree_b = tf::build(b, test::itself);
        const near_pairs all = pairs_by_brute_force(a, b);
        const auto between = [&](std::uint32_t i, std::uint32_t j) {
            return squared_between(a[i], b[j]);
        };
        for (const std::size_t k : {std::size_t{1}, std::size_t{7}, std::size_t{100}})
            REQUIRE(are_first(tf::k_nearest_pairs(tree_a, tree_b, k, between), all, k));
        const auto one = tf::nearest_pair(tree_a, tree_b, between);
        REQUIRE(are_first({*one}, all, 1));
    }
}

}  // namespace

TEST_CASE("nearest pair: there is none where a tree is empty, and none of zero are wanted") {
    const boxes<3> none;
    const boxes<3> one(1, test::box_at<3>({0, 0, 0}, 1.0));
    const auto empty = tf::build(none, test::itself);
    const auto tree = tf::build(one, test::itself);
    const auto never = [](std::uint32_t, std::uint32_t) -> double { throw std::logic_error("!"); };
    CHECK(!tf::nearest_pair(empty, tree, never));
    CHECK(!tf::nearest_pair(tree, empty, never));
    CHECK(!tf::nearest_pair(empty, empty, never));
    CHECK(tf::k_nearest_pairs(tree, tree, 0, never).empty());
}

TEST_CASE("nearest pair: boxes that coincide say nothing about contents in opposite corners") {
    // Each tree's primitives lie in two corners of the same box, never in a common one.
    const boxes<2> a{test::box_at<2>({0, 0}, 0.125), test::box_at<2>({1, 1}, 0.125)};
    const boxes<2> b{test::box_at<2>({0, 1}, 0.125), test::box_at<2>({1, 0}, 0.125)};
    const auto one = tf::nearest_pair(
        tf::build(a, test::itself), tf::build(b, test::itself),
        [&](std::uint32_t i, std::uint32_t j) { return squared_between(a[i], b[j]); });
    REQUIRE(one);
    CHECK(one->answer == 0.875 * 0.875);
    CHECK(one->id == tf::id_pair{0, 0});
}

TEST_CASE("nearest pair: the radius is inclusive") {
    const boxes<2> a{test::box_at<2>({0, 0}, 0.0)};
    const boxes<2> b{test::box_at<2>({3, 4}, 0.0)};
    const auto tree_a = tf::build(a, test::itself);
    const auto tree_b = tf::build(b, test::itself);
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
        return squared_between(a[i], b[j]);
    };
    CHECK(tf::nearest_pair(tree_a, tree_b, between, 5.0));
    CHECK(!tf::nearest_pair(tree_a, tree_b, between, std::nextafter(5.0, 0.0)));
    const boxes<2> grid = test::box_family<2>("grid", 300, 1);
    const auto tree = tf::build(grid, test::itself);
    const auto among = [&](std::uint32_t i, std::uint32_t j) {
        return squared_between(grid[i], grid[j]) + (i < 290 ? 1.0 : 0.0);
    };
    CHECK(tf::nearest_pair(tree, tree, among, 0.0)->answer == 0.0);
    CHECK(tf::k_nearest_pairs(tree, tree, 10, among, 0.0).size() == 10);
    CHECK_THROWS_AS((void)tf::nearest_pair(tree_a, tree_b, between, -1.0), std::invalid_argument);
}

TEST_CASE("nearest pair: one and k agree with brute force") {
    for (const std::string family : {"random", "grid", "equal", "line", "far", "mixed"}) {
        CAPTURE(family);
        for (const std::size_t count : {1U, 9U, 150U}) {
            CAPTURE(count);
            compare_pairs<2>(family, count);
            compare_pairs<3>(family, count);
        }
    }
}

TEST_CASE("nearest pair: a tree that is treated as transformed is searched where it is") {
    const boxes<3> a = test::box_family<3>("random", 200, 1);
    const boxes<3> b = test::box_family<3>("random", 300, 2);
    const auto tree_a = tf::build(a, test::itself);
    const auto tree_b = tf::build(b, test::itself);
    const std::array<double, 3> offset{1024, 0, 0};
    const boxes<3> there = shifted(b, 1024);
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
        return squared_between(a[i], there[j]);
    };
    const auto found = tf::k_nearest_pairs(
        tf::transformed<3>(tree_a),
        tf::transformed<3>(tree_b, tf::transform<3>::translation(offset)), 9, between);
    CHECK(are_first(found, pairs_by_brute_force(a, there), 9));
}

TEST_CASE("nearest pair: many equally near pairs give the same answer on any number of threads") {
    // Two flat sheets: every pair face to face is as near as any other, and the search is large
    // enough to be cut.
    boxes<3> a, b;
    for (int x = 0; x < 100; ++x)
        for (int y = 0; y < 100; ++y) {
            a.push_back(test::box_at<3>({1.0 * x, 1.0 * y, 0.0}, 0.0));
            b.push_back(test::box_at<3>({1.0 * x, 1.0 * y, 4.0}, 0.0));
        }
    test::random source(1);
    source.shuffle(b);
    const auto tree_a = tf::build(a, test::itself);
    const auto tree_b = tf::build(b, test::itself);
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
        return squared_between(a[i], b[j]);
    };
    boxes<3> c = b;
    for (auto& box : c) box.min[2] = box.max[2] = 0.0;
    const auto tree_c = tf::build(c, test::itself);
    const auto touching = [&](std::uint32_t i, std::uint32_t j) {
        return squared_between(a[i], c[j]);
    };
    const auto expected = tf::k_nearest_pairs(tree_a, tree_b, 20, between);
    for (std::uint32_t i = 0; i < 20; ++i) {
        CHECK(expected[i].id.first == i);
        CHECK(expected[i].answer == 16.0);
    }
    const auto zero = tf::k_nearest_pairs(tree_a, tree_c, 40, touching);
    for (const unsigned threads : {1U, 2U, 8U}) {
        const tf::thread_scope scope(threads);
        CHECK(tf::k_nearest_pairs(tree_a, tree_b, 20, between) == expected);
        CHECK(tf::k_nearest_pairs(tree_a, tree_c, 40, touching) == zero);
    }
}
