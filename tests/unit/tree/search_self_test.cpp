/// \file
/// The forms of the search of a tree by itself, against every box held against every other.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cstdint>
#include <string>

namespace {

using test::box_family;
using test::boxes;
using test::id_pairs;
using test::itself;

template <std::size_t D>
void check_self(const boxes<D>& of) {
    const auto accept = [&](std::uint32_t i, std::uint32_t j) { return overlaps(of[i], of[j]); };
    REQUIRE(tf::search_self_all(tf::build(of, itself), accept) == test::overlapping(of));
}

}  // namespace

TEST_CASE("search_self_all: finds the pairs that brute force finds, ascending") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {0UL, 1UL, 2UL, 8UL, 9UL, 300UL}) {
            CAPTURE(name);
            CAPTURE(count);
            check_self(box_family<3>(name, count, count));
            check_self(box_family<2>(name, count, count));
        }
}

TEST_CASE("search_self_all: a box that is infinite in the frame of the tree meets no empty slot") {
    for (const std::size_t count : {1UL, 3UL, 11UL, 70UL}) {
        boxes<3> of = box_family<3>("tiny", count, count);
        of[0] = {{-1e308, -1e308, -1e308}, {1e308, 1e308, 1e308}};
        of[count - 1] = of[0];
        check_self(of);
        CHECK(tf::search_self_all(tf::build(of, itself)).size() <= count * (count - 1) / 2);
    }
}

TEST_CASE("search_self_broad: blocks hold the pairs that search_self gives one by one") {
    const auto tree = tf::build(box_family<3>("random", 5'000, 1), itself);
    const auto by_block = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        return tf::search_self_broad<id_pairs>(tree, [&](id_pairs& mine, const auto& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                mine.emplace_back(tree.ids()[block.first[i]], tree.ids()[block.second[i]]);
        });
    };
    const auto one_by_one = tf::search_self<id_pairs>(
        tree, [](id_pairs& mine, std::uint32_t a, std::uint32_t b) { mine.emplace_back(a, b); });
    CHECK(by_block(1) == one_by_one);
    CHECK(by_block(8) == one_by_one);
}

TEST_CASE("search_self_any: says whether some pair is accepted") {
    const auto tree = tf::build(box_family<2>("grid", 4'000, 2), itself);
    const id_pairs all = tf::search_self_all(tree);
    REQUIRE(all.size() > 10'000);
    for (const std::size_t i : {std::size_t{0}, all.size() / 2, all.size() - 1})
        CHECK(tf::search_self_any(tree, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair{std::min(a, b), std::max(a, b)} == all[i];
        }));
    CHECK_FALSE(tf::search_self_any(tree, [](std::uint32_t, std::uint32_t) { return false; }));
}

TEST_CASE("self_search_chunks: statistics count the candidates") {
    const auto tree = tf::build(box_family<3>("random", 5'000, 3), itself);
    const tf::self_search_chunks<3> search(tree);
    tf::search_statistics seen;
    std::size_t candidates = 0;
    for (std::size_t chunk = 0; chunk < search.chunks(); ++chunk)
        seen += search.visit(chunk, [&](const tf::candidate_block& block) {
            candidates += block.first.size();
            return true;
        });
    CHECK(seen.candidates == candidates);
    CHECK(seen.box_tests >= seen.nodes);
    CHECK(seen.nodes > 0);
}
