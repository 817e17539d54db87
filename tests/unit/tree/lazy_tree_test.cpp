/// \file
/// Trees that are split where searches come by, against whole trees and brute force.

#include <treeform/tf.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/lazy_tree.hpp>
#include <treeform/tree/nearness_batch.hpp>
#include <treeform/tree/nearness_pair.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::itself;
using test::squared_between;
using ids = std::vector<std::uint32_t>;
using box3 = tf::aabb<double, 3>;

/// Boxes along a winding line: neighbors in the list are neighbors in space.
boxes<3> along_a_line(std::size_t count, std::uint64_t seed) {
    test::random random(seed);
    boxes<3> result;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(count);
        result.push_back(test::box_at<3>(
            {t + 0.01 * random.unit(), 0.1 * random.unit(), t * t + 0.01 * random.unit()}, 1e-3));
    }
    return result;
}

boxes<3> shuffled(boxes<3> of, std::uint64_t seed) {
    test::random random(seed);
    random.shuffle(of);
    return of;
}

/// Where a ray along the first axis enters a box.
std::optional<double> entry_along_x(const tf::ray<double, 3>& ray, const box3& of) {
    for (std::size_t k = 1; k < 3; ++k)
        if (ray.origin[k] < of.min[k] || of.max[k] < ray.origin[k]) return {};
    return of.min[0] - ray.origin[0];
}

void check_answers(const boxes<3>& of, std::uint64_t seed) {
    const auto whole = tf::build(of, itself);
    test::random random(seed);
    for (int i = 0; i < 20; ++i) {
        const tf::lazy_tree tree(of, itself);
        const box3 query =
            test::box_at<3>({random.unit(), 0.1 * random.unit(), random.unit()}, 0.05);
        const auto exact = [&](std::uint32_t id) { return overlaps(of[id], query); };
        const ids expected = tf::search_all(whole, query, exact);
        REQUIRE(tf::search_all(tree, query, exact) == expected);
        REQUIRE(tf::search_any(tree, query, exact) == !expected.empty());
        const auto distance = [&](std::uint32_t id) { return squared_between(of[id], query); };
        REQUIRE(tf::nearest(tree, query, distance) == tf::nearest(whole, query, distance));
        const tf::ray<double, 3> ray{{-1.0, query.min[1], query.min[2]}, {1, 0, 0}};
        const auto hit_of = [&](std::uint32_t id) { return entry_along_x(ray, of[id]); };
        const auto first = tf::first_hit(whole, ray, hit_of);
        const auto found = tf::first_hit(tree, ray, hit_of);
        REQUIRE(found.has_value() == first.has_value());
        if (first) REQUIRE(found->id == first->id);
        REQUIRE(tf::any_hit(tree, ray, hit_of) == first.has_value());
        REQUIRE(tree.built_block_count() <= tree.block_count());
    }
}

}  // namespace

TEST_CASE("lazy_tree: answers as a whole tree, in any order of the elements") {
    for (const std::size_t count : {1UL, 100UL, 4096UL, 4097UL, 30'000UL}) {
        CAPTURE(count);
        check_answers(along_a_line(count, count), 1);
        check_answers(shuffled(along_a_line(count, count), 2), 3);
    }
    check_answers(box_family<3>("equal", 9000, 4), 4);
    check_answers(box_family<3>("grid", 9000, 4), 5);
}

TEST_CASE("lazy_tree: splits only what a search comes into") {
    const boxes<3> of = along_a_line(100'000, 5);
    const tf::lazy_tree tree(of, itself);
    CHECK(tree.size() == 100'000);
    CHECK(tree.block_count() == 25);
    CHECK(tree.built_block_count() == 0);
    const box3 query = test::box_at<3>({0.5, 0.05, 0.25}, 1e-3);
    CHECK(!tf::search_any(tree, query, [](std::uint32_t) { return false; }));
    const std::size_t split = tree.built_block_count();
    CHECK(split >= 1);
    CHECK(split <= 3);
    CHECK(!tf::search_any(tree, query, [](std::uint32_t) { return false; }));
    CHECK(tree.built_block_count() == split);
}

TEST_CASE("lazy_tree: elements in random order are built at once") {
    const boxes<3> of = shuffled(along_a_line(50'000, 6), 7);
    const tf::lazy_tree tree(of, itself);
    CHECK(tree.block_count() == 1);
    CHECK(tree.built_block_count() == 1);
}

TEST_CASE("lazy_tree: two trees have a contact where brute force finds one, on 1, 2, 8 threads") {
    const boxes<3> a = along_a_line(20'000, 8);
    for (const double by : {0.0, 0.099, 0.2}) {
        boxes<3> b = along_a_line(20'000, 9);
        for (box3& one : b) one.min[1] += by, one.max[1] += by;
        const auto exact = [&](std::uint32_t x, std::uint32_t y) { return overlaps(a[x], b[y]); };
        const bool expected = tf::search_any(tf::build(a, itself), tf::build(b, itself), exact);
        CHECK(expected == (by < 0.15));
        for (const unsigned threads : {1U, 2U, 8U}) {
            const tf::thread_scope scope(threads);
            const tf::lazy_tree first(a, itself), second(b, itself);
            CHECK(tf::search_any(first, second, exact) == expected);
            if (by == 0.2) CHECK(first.built_block_count() + second.built_block_count() == 0);
        }
    }
}

TEST_CASE("lazy_tree: searches on several threads split a block once") {
    const boxes<3> of = along_a_line(40'000, 10);
    const tf::thread_scope scope(8);
    const tf::lazy_tree tree(of, itself);
    std::vector<std::size_t> found(64);
    tf::for_chunks(64, 1, [&](std::size_t i, std::size_t, std::size_t) {
        tf::search(tree, box3{{0, 0, 0}, {2, 2, 2}}, [&](std::uint32_t) { ++found[i]; });
    });
    for (const std::size_t one : found) CHECK(one == of.size());
    CHECK(tree.built_block_count() == tree.block_count());
}

TEST_CASE("lazy_tree: pairs, k nearest, batches and all hits are those of a whole tree") {
    const boxes<3> of = along_a_line(20'000, 12), few = along_a_line(300, 13);
    const auto whole = tf::build(of, itself);
    const tf::lazy_tree tree(of, itself);
    REQUIRE(tree.block_count() > 1);
    const auto self = [&](std::uint32_t x, std::uint32_t y) { return overlaps(of[x], of[y]); };
    CHECK(tf::search_self_all(tree, self) == tf::search_self_all(whole, self));
    CHECK(tf::search_self_any(tree, self));
    CHECK(!tf::search_self_any(tree, [](std::uint32_t, std::uint32_t) { return false; }));
    const auto both = [&](std::uint32_t x, std::uint32_t y) { return overlaps(of[x], few[y]); };
    const tf::dynamic_tree<3> others(few, itself);
    CHECK(tf::search_all(tree, others, both) == tf::search_all(whole, others, both));
    const auto between = [&](std::uint32_t x, std::uint32_t y) {
        const double squared = squared_between(of[x], few[y]);
        return squared > 0.0 ? squared : std::numeric_limits<double>::infinity();
    };
    const tf::transform<3> map = tf::transform<3>::translation(std::array{0.0, 0.0, 0.0});
    CHECK(tf::k_nearest_pairs(tf::transformed(tree, map), others, 9, between) ==
          tf::k_nearest_pairs(whole, tf::build(few, itself), 9, between));
    const auto from = [&](std::size_t query, std::uint32_t id) {
        return squared_between(of[id], few[query]);
    };
    CHECK(tf::nearest_batch(tree, few, from) == tf::nearest_batch(whole, few, from));
    CHECK(tf::k_nearest_batch(tree, few, 3, from).answers ==
          tf::k_nearest_batch(whole, few, 3, from).answers);
    CHECK(tf::all_within_batch(tree, few, 0.01, from).answers ==
          tf::all_within_batch(whole, few, 0.01, from).answers);
    const tf::ray<double, 3> ray{{-1.0, 0.05, 0.25}, {1, 0, 0}};
    const auto hit_of = [&](std::uint32_t id) { return entry_along_x(ray, of[id]); };
    const auto ids_of = [](const auto& hits) {
        ids result;
        for (const auto& hit : hits) result.push_back(hit.id);
        return result;
    };
    CHECK(ids_of(tf::all_hits(tree, ray, hit_of)) == ids_of(tf::all_hits(whole, ray, hit_of)));
}

TEST_CASE("lazy_tree: of nothing finds nothing") {
    const boxes<3> none;
    const tf::lazy_tree tree(none, itself);
    CHECK(tree.block_count() == 0);
    const box3 query = test::box_at<3>({0, 0, 0}, 1.0);
    CHECK(!tf::search_any(tree, query, [](std::uint32_t) { return true; }));
    CHECK(!tf::search_any(tree, tree, [](std::uint32_t, std::uint32_t) { return true; }));
    CHECK(!tf::nearest(tree, query, [](std::uint32_t) { return 0.0; }));
}

TEST_CASE("lazy_tree: refuses boxes that are not finite before any search, naming the element") {
    boxes<3> of = along_a_line(10'000, 11);
    of[9'999].max[2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(tf::lazy_tree(of, itself),
                         "treeform::lazy_tree: the box of element 9999 is empty or not finite",
                         std::invalid_argument);
}
