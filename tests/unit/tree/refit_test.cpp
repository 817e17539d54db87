/// \file
/// New boxes for an old tree, against trees that are built.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/refit.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::itself;

template <std::size_t D>
bool same_bytes(const tf::tree<D>& a, const tf::tree<D>& b) {
    if (!std::ranges::equal(a.ids(), b.ids()) || a.levels() != b.levels()) return false;
    for (unsigned level = 0; level < a.levels(); ++level)
        if (std::memcmp(a.level(level).data(), b.level(level).data(),
                        a.level(level).size_bytes()) != 0)
            return false;
    return true;
}

template <std::size_t D>
void check_against_build(const std::string& name, std::size_t count) {
    const boxes<D> before = box_family<D>(name, count, 1);
    const auto built = tf::build(before, itself);
    auto tree = built;
    tf::refit(tree, before, itself);
    REQUIRE(same_bytes(tree, built));

    const boxes<D> after = box_family<D>(name, count, 2);
    tf::refit(tree, after, itself);
    const auto defect = tf::why_malformed(tree, std::span(after));
    REQUIRE_MESSAGE(!defect, defect.value_or(""));
}

template <std::size_t D>
void check_partial(std::size_t count, std::size_t changed, std::uint64_t seed) {
    test::random random(seed);
    boxes<D> of = box_family<D>("random", count, seed);
    const boxes<D> others = box_family<D>("random", count, seed + 1);
    auto tree = tf::build(of, itself);
    auto whole = tree;
    const std::vector<std::uint32_t> place_of = tf::leaf_positions(tree);
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < changed; ++i) {
        const std::size_t id = random.below(count);
        of[id] = others[id];
        places.push_back(place_of[id]);
        if (i % 3 == 0) places.push_back(place_of[id]);
    }
    tf::refit(tree, of, itself, places);
    tf::refit(whole, of, itself);
    REQUIRE(same_bytes(tree, whole));
}

}  // namespace

TEST_CASE("refit: with the boxes of the build nothing changes, with others all is well formed") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {0U, 1U, 8U, 9U, 64U, 65U, 1000U, 5000U}) {
            CAPTURE(name);
            CAPTURE(count);
            check_against_build<2>(name, count);
            check_against_build<3>(name, count);
        }
}

TEST_CASE("refit: of some primitives, few or many, is that of all when only they have changed") {
    for (const std::size_t count : {1UL, 9UL, 100UL, 3000UL, 40000UL})
        for (const std::size_t changed : {0UL, 1UL, 2UL, count / 300, count / 10, count}) {
            CAPTURE(count);
            CAPTURE(changed);
            check_partial<2>(count, changed, count + changed);
            check_partial<3>(count, changed, count + changed);
        }
}

TEST_CASE("refit: what is not named keeps its box") {
    const boxes<3> of = box_family<3>("random", 1000, 3);
    const auto built = tf::build(of, itself);
    auto tree = built;
    const boxes<3> others = box_family<3>("random", 1000, 4);
    tf::refit(tree, others, itself, std::span<const std::uint32_t>{});
    CHECK(same_bytes(tree, built));
}

TEST_CASE("refit: the same tree on 1, 2 and 8 threads") {
    const boxes<3> before = box_family<3>("random", 60'000, 5);
    const boxes<3> after = box_family<3>("random", 60'000, 6);
    std::vector<std::uint32_t> places;
    for (std::uint32_t place = 0; place < 60'000; place += 3) places.push_back(place);
    const auto refitted_on = [&](unsigned threads, bool all) {
        const tf::thread_scope scope(threads);
        auto tree = tf::build(before, itself);
        if (all)
            tf::refit(tree, after, itself);
        else
            tf::refit(tree, after, itself, places);
        return tree;
    };
    for (const bool all : {true, false}) {
        const auto serial = refitted_on(1, all);
        CHECK(same_bytes(refitted_on(2, all), serial));
        CHECK(same_bytes(refitted_on(8, all), serial));
    }
}

TEST_CASE("refit: searches find what brute force finds in the new boxes") {
    const boxes<3> after = box_family<3>("random", 1500, 8);
    auto tree = tf::build(box_family<3>("random", 1500, 7), itself);
    tf::refit(tree, after, itself);
    CHECK(tf::search_self_all(tree, [&](std::uint32_t a, std::uint32_t b) {
              return overlaps(after[a], after[b]);
          }) == test::overlapping(after));
}

TEST_CASE("refit: refuses a box that is not finite, naming the element, and can be mended") {
    for (const double bad :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        boxes<3> of = box_family<3>("random", 20'000, 9);
        const boxes<3> sound = of;
        auto tree = tf::build(of, itself);
        const auto built = tree;
        of[12'345].max[1] = bad;
        const std::string complaint =
            "treeform::refit: the box of element 12345 is empty or not finite";
        CHECK_THROWS_WITH_AS(tf::refit(tree, of, itself), complaint.c_str(), std::invalid_argument);
        const std::vector<std::uint32_t> places{3, tf::leaf_positions(tree)[12'345], 77};
        CHECK_THROWS_WITH_AS(tf::refit(tree, of, itself, places), complaint.c_str(),
                             std::invalid_argument);
        tf::refit(tree, sound, itself);
        CHECK(same_bytes(tree, built));
    }
}

TEST_CASE("refit: refuses a position that the tree does not have") {
    const boxes<2> of = box_family<2>("random", 20, 1);
    auto tree = tf::build(of, itself);
    CHECK_THROWS_WITH_AS(tf::refit(tree, of, itself, std::vector<std::uint32_t>{3, 20}),
                         "treeform::refit: position 20 is not in the tree", std::invalid_argument);
}

TEST_CASE("refit: refuses a range that is not of the size of the tree") {
    auto tree = tf::build(box_family<2>("random", 20, 1), itself);
    for (const std::size_t size : {19U, 21U})
        CHECK_THROWS_AS(tf::refit(tree, box_family<2>("random", size, 1), itself),
                        std::invalid_argument);
}

TEST_CASE("search_cost: is 1 for one node, grows when neighbors part, and is not of a unit") {
    CHECK(tf::search_cost(tf::tree<3>{}) == 1.0);
    CHECK(tf::search_cost(tf::build(box_family<3>("random", 8, 1), itself)) == 1.0);
    CHECK(tf::search_cost(tf::build(box_family<2>("equal", 500, 1), itself)) ==
          doctest::Approx(1.0 + 8.0 + 63.0).epsilon(1e-6));
    boxes<3> of = box_family<3>("random", 5000, 2);
    auto tree = tf::build(of, itself);
    const double fresh = tf::search_cost(tree);
    CHECK(fresh > 1.0);
    for (auto& box : of)
        for (std::size_t k = 0; k < 3; ++k) box.min[k] *= 1024.0, box.max[k] *= 1024.0;
    CHECK(tf::search_cost(tf::build(of, itself)) == doctest::Approx(fresh).epsilon(1e-6));
    tf::refit(tree, box_family<3>("random", 5000, 3), itself);
    CHECK(tf::search_cost(tree) > 2.0 * fresh);
    for (const std::string& name : test::box_families)
        CHECK(std::isfinite(tf::search_cost(tf::build(box_family<3>(name, 700, 1), itself))));
}
