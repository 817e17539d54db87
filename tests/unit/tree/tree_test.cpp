#include <libtree/paper/nary_tree.hpp>
#include <libtree/paper/selections.hpp>
#include <libtree/paper/validate.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::box_at;
using test::boxes;
using test::itself;

const std::vector<std::size_t> sizes{0, 1, 2, 7, 8, 9, 16, 17, 63, 64, 65, 129, 1000, 4097};

using numbered_pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

template <std::size_t D>
numbered_pairs overlapping_by_brute_force(const boxes<D>& of) {
    numbered_pairs result;
    for (std::uint32_t a = 0; a < of.size(); ++a)
        for (std::uint32_t b = a + 1; b < of.size(); ++b)
            if (overlaps(of[a], of[b])) result.emplace_back(a, b);
    return result;
}

template <std::size_t D>
numbered_pairs overlapping_by_tree(const tf::tree<D>& tree, const boxes<D>& of) {
    numbered_pairs result;
    for (const numbered_pairs& chunk : tf::search_self<numbered_pairs>(
             tree, [&](numbered_pairs&found, std::uint32_t a, std::uint32_t b) {
                 if (overlaps(of[a], of[b])) found.emplace_back(std::min(a, b), std::max(a, b));
                 return false;
             }))
        result.insert(result.end(), chunk.begin(), chunk.end());
    std::sort(result.begin(), result.end());
    return result;
}

template <std::size_t D, class Build>
void check_family_by_family(const Build& make_tree) {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : sizes) {
            CAPTURE(name);
            CAPTURE(count);
            const boxes<D> of = test::box_family<D>(name, count, count);
            const auto tree = make_tree(of);
            const auto defect = tf::why_malformed(tree, std::span(of));
            REQUIRE_MESSAGE(!defect, defect.value_or(""));
        }
}

}  // namespace

TEST_CASE("build: every tree is well formed, whatever the boxes, in 3D") {
    check_family_by_family<3>([](const boxes<3>& of) { return tf::build(of, itself); });
}
TEST_CASE("build: every tree is well formed, whatever the boxes, in 2D") {
    check_family_by_family<2>([](const boxes<2>& of) { return tf::build(of, itself); });
}
TEST_CASE("build: a strategy of the caller's gives well-formed trees too") {
    check_family_by_family<3>(
        [](const boxes<3>& of) { return tf::build(tf::strategy::nth_element{}, of, itself); });
}
TEST_CASE("build: the paper's layout is well formed at every arity and leaf size") {
    for (const unsigned arity : {2U, 3U, 4U, 16U})
        for (const unsigned leaf : {1U, 4U, 7U})
            check_family_by_family<2>([&](const boxes<2>& of) {
                return tf::build(of, itself, {.inner_size = arity, .leaf_size = leaf});
            });
}

TEST_CASE("build: the tree is large enough to be cut by all threads and still well formed") {
    for (const char* name : {"random", "grid", "equal", "line", "mixed", "comb"}) {
        CAPTURE(name);
        const boxes<3> of = test::box_family<3>(name, 204'800, 5);
        const auto defect = tf::why_malformed(tf::build(of, itself), std::span(of));
        REQUIRE_MESSAGE(!defect, defect.value_or(""));
    }
}

TEST_CASE("build: the same tree on 1, 2 and 8 threads") {
    for (const char* name : {"random", "grid", "comb"}) {
        const boxes<3> of = test::box_family<3>(name, 150'000, 6);
        const auto ids_on = [&](unsigned threads) {
            const tf::thread_scope scope(threads);
            const auto tree = tf::build(of, itself);
            return std::vector<std::uint32_t>(tree.ids().begin(), tree.ids().end());
        };
        const auto serial = ids_on(1);
        CHECK(ids_on(2) == serial);
        CHECK(ids_on(8) == serial);
    }
}

TEST_CASE("build: a rebuild gives the tree of a fresh build") {
    tf::builder<3> builder;
    tf::tree<3> tree;
    for (const std::size_t count : {5000UL, 100UL, 20000UL, 0UL}) {
        const boxes<3> of = test::box_family<3>("random", count, count);
        builder.rebuild(tree, of, itself);
        const auto fresh = tf::build(of, itself);
        CHECK(std::ranges::equal(tree.ids(), fresh.ids()));
        CHECK(!tf::why_malformed(tree, std::span(of)));
    }
}

TEST_CASE("build: any range and any box maker, also one that can only be read once") {
    const boxes<2> of = test::box_family<2>("random", 300, 1);
    const std::list<tf::aabb<double, 2>> list(of.begin(), of.end());
    CHECK(std::ranges::equal(tf::build(list, itself).ids(), tf::build(of, itself).ids()));

    const std::vector<float> numbers{3.0F, 1.0F, 2.0F};
    const auto as_box = [](float x) {
        tf::aabb<float, 2> box;
        box.include(std::array{x, x});
        return box;
    };
    CHECK(tf::build(numbers, as_box).size() == 3);

    struct numbers_of_text {  // a view of the standard library is no range for Clang 14
        std::istream_iterator<float> first;
        [[nodiscard]] auto begin() const { return first; }
        [[nodiscard]] auto end() const { return std::istream_iterator<float>(); }
    };
    std::istringstream text("3 1 2");
    CHECK(std::ranges::equal(
        tf::build(numbers_of_text{std::istream_iterator<float>(text)}, as_box).ids(),
        tf::build(numbers, as_box).ids()));
}

TEST_CASE("build: refuses a box that is empty or not finite and names the element") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {infinity, -infinity, nan}) {
        boxes<3> of = test::box_family<3>("random", 30'000, 2);
        of[20'001].max[1] = bad;
        of[29'000].min[2] = bad;
        CHECK_THROWS_WITH_AS((void)tf::build(of, itself),
                             "treeform::build: the box of element 20001 is empty or not finite",
                             std::invalid_argument);
    }
    boxes<3> empty_box(1);
    CHECK_THROWS_AS((void)tf::build(empty_box, itself), std::invalid_argument);
}

TEST_CASE("build: refuses a box around a point with a coordinate that is NaN") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t corner : {0U, 1U, 2U}) {
        std::array<std::array<double, 3>, 3> triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
        triangle[corner][1] = nan;
        CHECK_THROWS_AS((void)tf::build(std::vector(1, triangle),
                                        [](const auto& t) {
                                            tf::aabb<double, 3> box;
                                            for (const auto& p : t) box.include(p);
                                            return box;
                                        }),
                        std::invalid_argument);
    }
}

TEST_CASE("tree: one that was never built is well formed over nothing") {
    CHECK(!tf::why_malformed(tf::tree<3>(), std::span<const tf::aabb<double, 3>>()));
}

TEST_CASE("build: refuses an arity or a leaf size that makes no tree") {
    const boxes<2> of = test::box_family<2>("random", 10, 2);
    CHECK_THROWS_AS((void)tf::build(of, itself, {.inner_size = 1}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::build(of, itself, {.inner_size = 17}), std::invalid_argument);
    CHECK_THROWS_AS((void)tf::build(of, itself, {.leaf_size = 0}), std::invalid_argument);
}

TEST_CASE("search_self: finds the pairs that brute force finds") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {0UL, 1UL, 2UL, 9UL, 70UL, 600UL, 2000UL}) {
            CAPTURE(name);
            CAPTURE(count);
            const boxes<3> of3 = test::box_family<3>(name, count, count + 1);
            REQUIRE(overlapping_by_tree(tf::build(of3, itself), of3) ==
                    overlapping_by_brute_force(of3));
            const boxes<2> of2 = test::box_family<2>(name, count, count + 2);
            REQUIRE(overlapping_by_tree(tf::build(of2, itself), of2) ==
                    overlapping_by_brute_force(of2));
        }
}

TEST_CASE("search_self: boxes that only touch are a pair, boxes one ulp apart are none") {
    const double next = std::nextafter(1.0, 2.0);
    boxes<3> of{box_at<3>({0, 0, 0}, 1.0), box_at<3>({1, 0, 0}, 1.0), box_at<3>({next, 5, 0}, 1.0),
                box_at<3>({0, 5, 0}, 1.0)};
    CHECK(overlapping_by_tree(tf::build(of, itself), of) == numbered_pairs{{0, 1}});
}

TEST_CASE("search_self: no pair comes twice") {
    const boxes<3> of = test::box_family<3>("grid", 3000, 3);
    const tf::tree<3> tree = tf::build(of, itself);
    const tf::self_search_chunks<3> search(tree);
    numbered_pairs all;
    for (std::size_t chunk = 0; chunk < search.chunks(); ++chunk)
        search.visit(chunk, [&](const tf::candidate_block& block) {
            for (std::size_t i = 0; i < block.first.size(); ++i) {
                REQUIRE(block.first[i] < block.second[i]);
                all.emplace_back(block.first[i], block.second[i]);
            }
            return true;
        });
    std::sort(all.begin(), all.end());
    CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
}

TEST_CASE("search_self: stops at the pair that one thread would stop at") {
    const boxes<3> of = test::box_family<3>("random", 50'000, 4);
    const tf::tree<3> tree = tf::build(of, itself);
    const auto first_pair_on = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        const auto states = tf::search_self<numbered_pairs>(
            tree, [](numbered_pairs& found, std::uint32_t a, std::uint32_t b) {
                found.emplace_back(a, b);
                return a % 7 == 3 && b % 11 == 5;
            });
        REQUIRE(!states.empty());
        return states;
    };
    const auto serial = first_pair_on(1);
    CHECK(first_pair_on(2) == serial);
    CHECK(first_pair_on(8) == serial);
}

TEST_CASE("tree: boxes far from the origin are not blown up by their float form") {
    // Parts of size 1e-3 at 1e6, where a float has steps of 0.06: about the origin of the file
    // every box would meet hundreds of others.
    const boxes<3> of = test::box_family<3>("far", 20'000, 7);
    const auto count = [](const tf::tree<3>& tree) {
        std::size_t candidates = 0;
        const tf::self_search_chunks<3> search(tree);
        for (std::size_t chunk = 0; chunk < search.chunks(); ++chunk)
            search.visit(chunk, [&](const tf::candidate_block& block) {
                candidates += block.first.size();
                return true;
            });
        return candidates;
    };
    boxes<3> near = of;
    for (auto& box : near) box.min[0] -= 1e6, box.max[0] -= 1e6;
    CHECK(count(tf::build(of, itself)) <= count(tf::build(near, itself)) + 20);
}

TEST_CASE("tree: at most 32 bytes a primitive, at powers of the width and behind them") {
    for (const std::size_t size : {512U, 513U, 4096U, 4097U, 32768U, 32769U, 100000U, 262145U}) {
        CAPTURE(size);
        tf::tree<3> tree;
        tree.reset(size);
        std::size_t nodes = 0;
        for (unsigned level = 0; level < tree.levels(); ++level) nodes += tree.level(level).size();
        const std::size_t bytes = nodes * sizeof(tf::wide_node<3>) + tree.ids().size_bytes();
        CHECK(bytes <= 32 * size + tree.levels() * sizeof(tf::wide_node<3>));
    }
}

TEST_CASE("aabb: from one point it is the box of that point, and by default it is empty") {
    constexpr tf::aabb<double, 3> at{{1, 2, 3}};
    CHECK(at == tf::aabb<double, 3>{{1, 2, 3}, {1, 2, 3}});
    CHECK(!at.empty());
    CHECK(tf::overlaps(at, tf::aabb<double, 3>{{0, 2, 0}, {1, 2, 9}}));
    CHECK(tf::aabb<float, 2>{.min = {-1, 5}}.max == std::array{-1.0F, 5.0F});
    constexpr tf::aabb<double, 2> none;
    CHECK(none.empty());
    CHECK(none.max[0] == -std::numeric_limits<double>::infinity());
    CHECK(none == tf::aabb<double, 2>{});
    CHECK(tf::aabb<double, 2>{{std::numeric_limits<double>::quiet_NaN(), 0}}.empty());
}
