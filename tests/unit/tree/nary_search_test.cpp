/// \file
/// The paper's searches over its own tree, against brute force and against the wide tree.

#include <libtree/paper/nary_search.hpp>
#include <libtree/paper/nary_tree.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::id_pairs;
using test::itself;

constexpr auto overlap = [](const auto& a, const auto& b) { return overlaps(a, b); };

id_pairs sorted(const std::vector<id_pairs>& parts) {
    id_pairs all = tf::detail::joined(parts);
    std::sort(all.begin(), all.end());
    return all;
}

template <std::size_t D>
void check_nary(const std::string& name, const tf::tree_config& config) {
    for (const std::size_t count : {0UL, 1UL, 5UL, 300UL}) {
        CAPTURE(name);
        CAPTURE(count);
        const boxes<D> a = box_family<D>(name, count, 1), b = box_family<D>("random", 150, 2);
        const auto tree_a = tf::build(a, itself, config);
        const auto tree_b = tf::build(b, itself, config);
        REQUIRE(sorted(tf::search<id_pairs>(tree_a, tree_b, overlap,
                                            [&](id_pairs& mine, std::uint32_t i, std::uint32_t j) {
                                                if (overlaps(a[i], b[j])) mine.emplace_back(i, j);
                                            })) == test::overlapping(a, b));
        REQUIRE(sorted(tf::search_self<id_pairs>(
                    tree_a, overlap, [&](id_pairs& mine, std::uint32_t i, std::uint32_t j) {
                        if (overlaps(a[i], a[j])) mine.emplace_back(std::min(i, j), std::max(i, j));
                    })) == test::overlapping(a));
        std::vector<std::uint32_t> found;
        const auto touches = [&](const auto& box) { return overlaps(box, b[0]); };
        tf::search(tree_a, touches, [&](std::uint32_t id) {
            if (touches(a[id])) found.push_back(id);
        });
        std::sort(found.begin(), found.end());
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < a.size(); ++i)
            if (touches(a[i])) expected.push_back(i);
        REQUIRE(found == expected);
    }
}

}  // namespace

TEST_CASE("nary search: finds what brute force finds at every arity and leaf size") {
    for (const std::string& name : test::box_families)
        for (const unsigned arity : {2U, 3U, 4U, 16U})
            for (const unsigned leaf : {1U, 4U, 7U}) {
                CAPTURE(arity);
                CAPTURE(leaf);
                check_nary<2>(name, {.inner_size = arity, .leaf_size = leaf});
                check_nary<3>(name, {.inner_size = arity, .leaf_size = leaf});
            }
}

TEST_CASE("nary search: the same on any number of threads, and stops at the same pair") {
    const boxes<3> a = box_family<3>("random", 20'000, 3), b = box_family<3>("random", 10'000, 4);
    const auto tree_a = tf::build(a, itself, {});
    const auto tree_b = tf::build(b, itself, {});
    const auto on = [&](unsigned threads, bool stops) {
        const tf::thread_scope scope(threads);
        return tf::search<id_pairs>(tree_a, tree_b, overlap,
                                    [&](id_pairs& mine, std::uint32_t i, std::uint32_t j) {
                                        mine.emplace_back(i, j);
                                        return stops && i % 31 == 3 && j % 37 == 5;
                                    });
    };
    for (const bool stops : {false, true}) {
        const auto serial = on(1, stops);
        CHECK(on(2, stops) == serial);
        CHECK(on(8, stops) == serial);
    }
}

TEST_CASE("nary search: ends where it is told to") {
    const auto tree = tf::build(box_family<2>("grid", 500, 5), itself, {});
    std::size_t calls = 0;
    tf::search(
        tree, [](const auto&) { return true; }, [&](std::uint32_t) { return ++calls == 3; });
    CHECK(calls == 3);
    calls = 0;
    tf::search_broad(
        tree, [](const auto&) { return true; },
        [&](auto ids) { return (calls += ids.size()) > 9; });
    CHECK(calls > 9);
    CHECK(calls <= 13);
}
