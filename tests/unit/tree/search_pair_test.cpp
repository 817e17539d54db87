/// \file
/// Pairs of primitives of two trees, against every box held against every other.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search_pair.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace {

using test::box_family;
using test::boxes;
using test::id_pairs;
using test::itself;

template <std::size_t D>
id_pairs found(const boxes<D>& a, const boxes<D>& b) {
    return tf::search_all(tf::build(a, itself), tf::build(b, itself),
                          [&](std::uint32_t i, std::uint32_t j) { return overlaps(a[i], b[j]); });
}

template <std::size_t D>
void check_two_trees(const boxes<D>& a, const boxes<D>& b) {
    const id_pairs expected = test::overlapping(a, b);
    REQUIRE(found(a, b) == expected);
    id_pairs turned;
    for (const auto& [i, j] : expected) turned.emplace_back(j, i);
    std::sort(turned.begin(), turned.end());
    REQUIRE(found(b, a) == turned);
}

/// The box of the images of all corners of `box`, which is that of the image of the box where
/// `by` does not round.
template <std::size_t D>
tf::aabb<double, D> image(const tf::aabb<double, D>& box, const tf::transform<D>& by) {
    tf::aabb<double, D> result;
    for (unsigned corner = 0; corner < 1U << D; ++corner) {
        std::array<double, D> p{};
        for (std::size_t k = 0; k < D; ++k)
            p[k] = (corner >> k & 1U) != 0 ? box.max[k] : box.min[k];
        result.include(by(p));
    }
    return result;
}

template <std::size_t D>
boxes<D> images(const boxes<D>& of, const tf::transform<D>& by) {
    boxes<D> result;
    for (const auto& box : of) result.push_back(image(box, by));
    return result;
}

/// Entries that are multiples of 1/16 up to 2: products with coarse coordinates are exact.
template <std::size_t D>
tf::transform<D> coarse_map(test::random& source) {
    tf::transform<D> map;
    for (auto& row : map.rows)
        for (double& entry : row) entry = static_cast<double>(source.below(65)) / 16.0 - 2.0;
    return map;
}

template <std::size_t D>
boxes<D> coarse_boxes(test::random& source, std::size_t count) {
    boxes<D> result;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, D> corner{};
        for (double& x : corner) x = static_cast<double>(source.below(4096)) / 1024.0 - 2.0;
        result.push_back(test::box_at<D>(corner, static_cast<double>(source.below(256)) / 1024.0));
    }
    return result;
}

template <std::size_t D>
void check_under_maps() {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const boxes<D> a = coarse_boxes<D>(source, 150), b = coarse_boxes<D>(source, 90);
        const auto by_a = coarse_map<D>(source), by_b = coarse_map<D>(source);
        const auto tree_a = tf::build(a, itself);
        const auto tree_b = tf::build(b, itself);
        const auto check_two_trees = [&](const auto& on_a, const auto& on_b,
                                         const boxes<D>& moved_a, const boxes<D>& moved_b) {
            const id_pairs pairs = tf::search_all(
                on_a, on_b,
                [&](std::uint32_t i, std::uint32_t j) { return overlaps(moved_a[i], moved_b[j]); });
            REQUIRE(pairs == test::overlapping(moved_a, moved_b));
        };
        check_two_trees(tf::transformed{tree_a, by_a}, tree_b, images(a, by_a), b);
        check_two_trees(tree_a, tf::transformed{tree_b, by_b}, a, images(b, by_b));
        check_two_trees(tf::transformed{tree_a, by_a}, tf::transformed{tree_b, by_b},
                        images(a, by_a), images(b, by_b));
    }
}

const std::size_t counts[] = {0, 1, 2, 8, 9, 65, 600};

}  // namespace

TEST_CASE("search of two trees: finds the pairs that brute force finds, whatever the sizes") {
    for (const std::size_t m : counts)
        for (const std::size_t n : counts) {
            CAPTURE(m);
            CAPTURE(n);
            check_two_trees(box_family<3>("random", m, m), box_family<3>("random", n, n + 1));
            check_two_trees(box_family<2>("grid", m, m), box_family<2>("grid", n, n + 1));
        }
}

TEST_CASE("search of two trees: finds them between trees of any two frames and scales") {
    for (const std::string& a : test::box_families)
        for (const std::string& b : test::box_families) {
            CAPTURE(a);
            CAPTURE(b);
            check_two_trees(box_family<3>(a, 130, 1), box_family<3>(b, 70, 2));
            check_two_trees(box_family<2>(a, 40, 3), box_family<2>(b, 300, 4));
        }
}

TEST_CASE("search of two trees: finds the pairs of scaled and shifted copies") {
    for (const int exponent : {-1000, -300, -126, -60, -20, -1, 1, 25, 59, 127, 500, 1020})
        for (const double shift : {0.0, 0.5, -1e10}) {
            CAPTURE(exponent);
            CAPTURE(shift);
            boxes<3> a = box_family<3>("random", 300, 5);
            boxes<3> b = box_family<3>("random", 100, 6);
            for (auto& box : b)
                for (std::size_t k = 0; k < 3; ++k) {
                    box.min[k] = std::ldexp(box.min[k], exponent);
                    box.max[k] = std::ldexp(box.max[k], exponent);
                }
            for (auto& box : a) box.min[0] += shift, box.max[0] += shift;
            check_two_trees(a, b);
        }
}

TEST_CASE("search of two trees: a tiny tree in a large one meets only what is near it") {
    // In units of the tiny tree the large one is beyond the range of float; all of it would meet.
    const boxes<3> large = box_family<3>("random", 20'000, 7);
    boxes<3> tiny;
    for (auto box : box_family<3>("random", 500, 8)) {
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = std::ldexp(box.min[k], -200);
            box.max[k] = std::ldexp(box.max[k], -200);
        }
        tiny.push_back(box);
    }
    const auto tree_of_large = tf::build(large, itself);
    const auto tree_of_tiny = tf::build(tiny, itself);
    CHECK(tf::search_all(tree_of_large, tree_of_tiny).size() < 500 * 100);
    CHECK(tf::search_all(tree_of_tiny, tree_of_large).size() < 500 * 100);
}

TEST_CASE("search of two trees: boxes that only touch are a pair, boxes one ulp apart are none") {
    const double next = std::nextafter(1.0, 2.0);
    const boxes<3> a{test::box_at<3>({0, 0, 0}, 1.0)};
    CHECK(found(a, {test::box_at<3>({1, 0, 0}, 1.0), test::box_at<3>({next, 0, 0}, 1.0),
                    test::box_at<3>({1, 1, 1}, 0.0)}) == id_pairs{{0, 0}, {0, 2}});
}

TEST_CASE("search of two trees: no pair comes twice, and statistics count them") {
    const auto a = tf::build(box_family<3>("grid", 3000, 9), itself);
    const auto b = tf::build(box_family<3>("random", 2000, 10), itself);
    const tf::pair_search_chunks<3> search(a, b);
    id_pairs all;
    tf::search_statistics seen;
    for (std::size_t chunk = 0; chunk < search.chunks(); ++chunk)
        seen += search.visit(chunk, [&](const tf::candidate_block& block) {
            CHECK(block.first.size() <= tf::max_candidates);
            for (std::size_t i = 0; i < block.first.size(); ++i)
                all.emplace_back(block.first[i], block.second[i]);
            return true;
        });
    CHECK(seen.candidates == all.size());
    CHECK(seen.nodes > 0);
    CHECK(seen.box_tests >= seen.nodes);
    id_pairs at_once;
    const auto seen_at_once =
        tf::pair_search_chunks<3>::visit_all(a, b, [&](const tf::candidate_block& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                at_once.emplace_back(block.first[i], block.second[i]);
            return true;
        });
    CHECK(at_once == all);
    CHECK(seen_at_once.candidates == all.size());
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("search of two trees: what is out of reach is not looked at") {
    boxes<3> away = box_family<3>("random", 20'000, 11);
    for (auto& box : away) box.min[0] += 1.5, box.max[0] += 1.5;
    const auto a = tf::build(box_family<3>("random", 20'000, 12), itself);
    const auto b = tf::build(away, itself);
    CHECK(tf::pair_search_chunks<3>(a, b).chunks() == 0);
    for (auto& box : away) box.min[0] -= 0.5, box.max[0] -= 0.5;  // 0.05 in common
    const auto seen = tf::pair_search_chunks<3>::visit_all(a, tf::build(away, itself),
                                                           [](const auto&) { return true; });
    CHECK(seen.candidates > 0);
    CHECK(seen.nodes < 20'000 / 8);
}

TEST_CASE("search of two trees: stops at the pair that one thread would stop at") {
    const auto a = tf::build(box_family<3>("random", 20'000, 13), itself);
    const auto b = tf::build(box_family<3>("random", 20'000, 14), itself);
    const auto states_on = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        return tf::search<id_pairs>(a, b, [](id_pairs& mine, std::uint32_t x, std::uint32_t y) {
            mine.emplace_back(x, y);
            return x % 31 == 3 && y % 37 == 5;
        });
    };
    const auto serial = states_on(1);
    REQUIRE(!serial.empty());
    CHECK(serial.back().back().first % 31 == 3);
    CHECK(states_on(2) == serial);
    CHECK(states_on(8) == serial);
}

TEST_CASE("search of two trees: blocks hold the same pairs, on any number of threads") {
    const auto a = tf::build(box_family<2>("random", 9'000, 15), itself);
    const auto b = tf::build(box_family<2>("line", 5'000, 16), itself);
    const auto states_on = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        return tf::search_broad<id_pairs>(a, b, [](id_pairs& mine, const auto& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i)
                mine.emplace_back(block.first[i], block.second[i]);
        });
    };
    const auto serial = states_on(1);
    CHECK(states_on(2) == serial);
    CHECK(states_on(8) == serial);
    id_pairs all = tf::detail::joined(serial);
    for (auto& [x, y] : all) x = a.ids()[x], y = b.ids()[y];
    std::sort(all.begin(), all.end());
    CHECK(all == tf::search_all(a, b));
}

TEST_CASE("search_any: says whether some pair is accepted, and stops asking") {
    const auto a = tf::build(box_family<3>("random", 20'000, 17), itself);
    const auto b = tf::build(box_family<3>("random", 20'000, 18), itself);
    std::atomic<std::size_t> asked{0};
    CHECK(tf::search_any(a, b, [&](std::uint32_t, std::uint32_t) { return ++asked != 0; }));
    CHECK(asked.load() == 1);
    const id_pairs all = tf::search_all(a, b);
    REQUIRE(all.size() > 10'000);
    for (const std::size_t i : {std::size_t{0}, all.size() / 2, all.size() - 1})
        CHECK(tf::search_any(a, b, [&](std::uint32_t x, std::uint32_t y) {
            return std::pair{x, y} == all[i];
        }));
    CHECK_FALSE(tf::search_any(a, b, [](std::uint32_t, std::uint32_t) { return false; }));
    CHECK_FALSE(
        tf::search_any(tf::tree<3>{}, b, [](std::uint32_t, std::uint32_t) { return true; }));
}

TEST_CASE("search of transformed trees: no pair of exact images is missed, in 3D") {
    check_under_maps<3>();
}
TEST_CASE("search of transformed trees: no pair of exact images is missed, in 2D") {
    check_under_maps<2>();
}

TEST_CASE("search of transformed trees: no pair of images rounded to double is missed") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const std::string name = test::box_families[seed % 6];
        boxes<3> a = box_family<3>(name, 200, seed);
        for (auto& box : a) box.max = box.min;  // points, so that images are what the map says
        tf::transform<3> map;
        for (auto& row : map.rows)
            for (double& entry : row) entry = source.in(-1, 1);
        if (seed % 3 == 0) map.rows[0][3] = 1e9;
        if (seed % 3 == 1) map.rows[1] = map.rows[0];  // singular
        const boxes<3> moved = images(a, map);
        // Against the images themselves: each meets its own to the last bit.
        const auto tree_a = tf::build(a, itself);
        const auto tree_b = tf::build(moved, itself);
        const auto pairs = tf::search_all(
            tf::transformed{tree_a, map}, tree_b,
            [&](std::uint32_t i, std::uint32_t j) { return overlaps(moved[i], moved[j]); });
        REQUIRE(pairs == test::overlapping(moved, moved));
        REQUIRE(pairs.size() >= 200);
    }
}

TEST_CASE("search of transformed trees: a turned tree meets about what it met before") {
    const boxes<3> a = box_family<3>("random", 5'000, 19);
    const boxes<3> b = box_family<3>("random", 5'000, 20);
    const auto tree_a = tf::build(a, itself);
    const auto tree_b = tf::build(b, itself);
    const tf::transform<3> quarter{{{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}}};
    const auto turned = tf::build(images(a, quarter), itself);
    const auto by_map = tf::search_all(tf::transformed{tree_a, quarter}, tree_b);
    const auto built = tf::search_all(turned, tree_b);
    CHECK(by_map.size() < built.size() + built.size() / 100 + 10);
    CHECK(tf::search_all(tf::transformed{tree_a, tf::transform<3>{}}, tree_b) ==
          tf::search_all(tree_a, tree_b));
}

TEST_CASE("transformed: refuses a map with an entry that is not finite") {
    const tf::tree<3> tree = tf::build(box_family<3>("random", 3, 21), itself);
    tf::transform<3> map;
    map.rows[2][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::transformed(tree, map), std::invalid_argument);
}
