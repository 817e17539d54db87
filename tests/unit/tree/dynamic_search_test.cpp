/// \file
/// Searches of sets of boxes that change, against brute force over what there is.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/nearness_batch.hpp>
#include <treeform/tree/nearness_pair.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>
#include <support/dynamic_twin.hpp>
#include <support/extremes.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::box;
using test::box_family;
using test::boxes;
using test::ids;
using test::infinity;
using test::itself;
using test::squared_between;
using test::twin;

template <std::size_t D>
std::optional<double> entry(const tf::ray<double, D>& r, const box<D>& b) {
    double near = r.t_min, far = r.t_max;
    for (std::size_t k = 0; k < D; ++k) {
        const double x = (b.min[k] - r.origin[k]) / r.direction[k];
        const double y = (b.max[k] - r.origin[k]) / r.direction[k];
        near = std::max(near, std::min(x, y));
        far = std::min(far, std::max(x, y));
    }
    return near <= far ? std::optional(near) : std::nullopt;
}

template <std::size_t D>
void check_twin_boxes(const twin<D>& both, const box<D>& query) {
    ids expected;
    for (const auto& [id, of] : both.all)
        if (overlaps(of, query)) expected.push_back(id);
    const auto exact = [&](std::uint32_t id) { return overlaps(both.all.at(id), query); };
    const auto check = [&](const box<D>& other) { return overlaps(other, query); };
    REQUIRE(tf::search_all(both.tree, query, exact) == expected);
    REQUIRE(tf::search_all(both.tree, check, exact) == expected);
    REQUIRE(tf::search_any(both.tree, query, exact) == !expected.empty());
    ids in_blocks;
    tf::search_broad(both.tree, query, [&](std::span<const std::uint32_t> block) {
        for (const std::uint32_t id : block)
            if (exact(id)) in_blocks.push_back(id);
    });
    std::sort(in_blocks.begin(), in_blocks.end());
    REQUIRE(in_blocks == expected);
    ids everything;
    tf::search(
        both.tree, [](const box<D>&) { return true; },
        [&](std::uint32_t id) { everything.push_back(id); });
    REQUIRE(everything.size() == both.all.size());
}

template <std::size_t D>
void check_nearness(const twin<D>& both, const box<D>& query) {
    std::vector<tf::neighbor<double>> expected;
    for (const auto& [id, of] : both.all) expected.push_back({id, squared_between(of, query)});
    std::sort(expected.begin(), expected.end(),
              [](const auto& a, const auto& b) { return nearer(a, b); });
    const auto distance = [&](std::uint32_t id) { return squared_between(both.all.at(id), query); };
    const auto nearest = tf::nearest(both.tree, query, distance);
    REQUIRE(nearest.has_value() == !expected.empty());
    if (nearest) REQUIRE(*nearest == expected[0]);
    auto five = expected;
    five.resize(std::min<std::size_t>(five.size(), 5));
    REQUIRE(tf::k_nearest(both.tree, query, 5, distance) == five);
    std::erase_if(expected, [](const auto& one) { return one.answer > 0.2 * 0.2; });
    REQUIRE(tf::all_within(both.tree, query, 0.2, distance) == expected);
}

template <std::size_t D>
void check_ray(const twin<D>& both, const box<D>& query, test::random& random) {
    tf::ray<double, D> ray{.origin = query.min};
    for (double& x : ray.direction) x = random.unit() - 0.5;
    std::vector<std::pair<double, std::uint32_t>> expected;
    const auto hit_of = [&](std::uint32_t id) { return entry(ray, both.all.at(id)); };
    for (const auto& [id, of] : both.all)
        if (const auto t = hit_of(id)) expected.emplace_back(*t, id);
    std::sort(expected.begin(), expected.end());
    const auto first = tf::first_hit(both.tree, ray, hit_of);
    REQUIRE(first.has_value() == !expected.empty());
    if (first) REQUIRE(std::pair(first->hit, first->id) == expected[0]);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (const auto& hit : tf::all_hits(both.tree, ray, hit_of))
        found.emplace_back(hit.hit, hit.id);
    REQUIRE(found == expected);
    REQUIRE(tf::any_hit(both.tree, ray, hit_of) == !expected.empty());
    std::size_t visits = 0;
    tf::visit_ray(both.tree, ray, [&](std::uint32_t) {
        ++visits;
        return -infinity;
    });
    REQUIRE(visits <= 1);
}

template <std::size_t D>
void check_pairs(const twin<D>& both, const boxes<D>& others) {
    std::vector<tf::id_pair> self, with;
    for (auto a = both.all.begin(); a != both.all.end(); ++a) {
        for (auto b = std::next(a); b != both.all.end(); ++b)
            if (overlaps(a->second, b->second)) self.emplace_back(a->first, b->first);
        for (std::uint32_t j = 0; j < others.size(); ++j)
            if (overlaps(a->second, others[j])) with.emplace_back(a->first, j);
    }
    const auto& of = both.all;
    const auto in_self = [&](std::uint32_t a, std::uint32_t b) {
        return overlaps(of.at(a), of.at(b));
    };
    REQUIRE(tf::search_self_all(both.tree, in_self) == self);
    REQUIRE(tf::search_self_any(both.tree, in_self) == !self.empty());
    const tf::tree<D> other = tf::build(others, itself);
    const auto in_both = [&](std::uint32_t a, std::uint32_t b) {
        return overlaps(of.at(a), others[b]);
    };
    REQUIRE(tf::search_all(both.tree, other, in_both) == with);
    REQUIRE(tf::search_any(both.tree, other, in_both) == !with.empty());
    std::vector<tf::id_pair> swapped;
    for (const auto& [b, a] : tf::search_all(
             other, both.tree, [&](std::uint32_t b, std::uint32_t a) { return in_both(a, b); }))
        swapped.emplace_back(a, b);
    std::sort(swapped.begin(), swapped.end());
    REQUIRE(swapped == with);
}

template <std::size_t D>
void check_twin_answers(const twin<D>& both, test::random& random, const boxes<D>& source) {
    check_shape(both);
    for (int i = 0; i < 2; ++i) {
        box<D> query = source[random.below(source.size())];
        for (std::size_t k = 0; k < D; ++k) query.min[k] -= 0.05;
        check_twin_boxes(both, query);
        check_nearness(both, query);
        check_ray(both, query, random);
    }
    check_pairs(both, boxes<D>(source.begin(), source.begin() + 20));
}

template <std::size_t D>
void check_long_run(const std::string& family, std::uint64_t seed) {
    test::random random(seed);
    const boxes<D> source = box_family<D>(family, 300, seed);
    twin<D> both;
    (void)both.insert(box_family<D>(family, 400, seed + 1));
    for (int step = 0; step < 60; ++step) {
        both.step(random, source);
        if (step % 6 == 0) check_twin_answers(both, random, source);
    }
    both.remove(both.some(both.all.size(), random));
    check_twin_answers(both, random, source);
    (void)both.insert(source);
    check_twin_answers(both, random, source);
}

template <std::size_t D>
boxes<D> all_of(const tf::dynamic_tree<D>& tree) {
    boxes<D> result;
    for (std::uint32_t id = 0; id < tree.id_end(); ++id)
        if (tree.contains(id)) result.push_back(tree.box(id));
    return result;
}

/// Nodes opened by searches for some boxes.
template <class Tree>
std::uint64_t nodes_opened(const Tree& tree, const boxes<3>& queries) {
    tf::search_statistics seen;
    for (const box<3>& query : queries) seen += tf::search(tree, query, [](std::uint32_t) {});
    return seen.nodes;
}

}  // namespace

TEST_CASE("dynamic_tree: after any updates all answers are those of brute force, in 3D") {
    for (const char* family : {"random", "grid", "equal", "line"}) {
        CAPTURE(family);
        check_long_run<3>(family, 3);
    }
}
TEST_CASE("dynamic_tree: after any updates all answers are those of brute force, in 2D") {
    for (const char* family : {"random", "grid", "far"}) {
        CAPTURE(family);
        check_long_run<2>(family, 4);
    }
}

TEST_CASE("dynamic_tree: boxes of any size and place keep their pairs when some come and go") {
    for (const std::string& family : test::box_families) {
        CAPTURE(family);
        test::random random(5);
        const boxes<3> source = box_family<3>(family, 250, 6);
        twin<3> both;
        (void)both.insert(box_family<3>(family, 250, 7));
        for (int step = 0; step < 10; ++step) {
            const ids which = both.some(30, random);
            boxes<3> to;
            for (std::size_t i = 0; i < which.size(); ++i)
                to.push_back(source[random.below(source.size())]);
            both.move(which, to);
            both.remove(both.some(10, random));
        }
        check_shape(both);
        check_pairs(both, source);
    }
}

TEST_CASE("dynamic_tree: empty, of one, and empty again") {
    twin<2> both;
    test::random random(1);
    const boxes<2> source = box_family<2>("random", 20, 1);
    check_twin_answers(both, random, source);
    (void)both.insert({});
    both.remove({});
    both.move({}, {});
    CHECK(both.tree.top().empty());
    CHECK(both.insert({source[0]}) == ids{0});
    check_twin_answers(both, random, source);
    both.move({0}, {source[1]});
    check_twin_answers(both, random, source);
    both.remove({0});
    check_twin_answers(both, random, source);
    CHECK(both.tree.top().empty());
}

TEST_CASE("dynamic_tree: two dynamic trees, moved or not, meet where brute force says") {
    test::random random(8);
    const boxes<3> source = box_family<3>("random", 300, 9);
    twin<3> a, b;
    (void)a.insert(box_family<3>("random", 300, 10));
    (void)b.insert(box_family<3>("random", 200, 11));
    for (twin<3>* const one : {&a, &b}) {
        for (int step = 0; step < 12; ++step) one->step(random, source);
        (void)one->insert(source);
        (void)one->insert(boxes<3>(source.begin(), source.begin() + 20));
        one->remove(one->some(100, random));
        REQUIRE(one->tree.top().size() > 1);
    }
    tf::transform<3> map;
    map.rows[0][3] = 0.25;  // exact for boxes of multiples of 2^-53 in [0, 1)
    for (const bool moved : {false, true}) {
        const auto at = [&](box<3> of) {
            if (moved) of.min[0] += 0.25, of.max[0] += 0.25;
            return of;
        };
        const auto meet = [&](std::uint32_t x, std::uint32_t y) {
            return overlaps(at(a.all.at(x)), b.all.at(y));
        };
        const auto distance = [&](std::uint32_t x, std::uint32_t y) {
            return squared_between(at(a.all.at(x)), b.all.at(y));
        };
        std::vector<tf::id_pair> expected;
        std::vector<tf::neighbor<double, tf::id_pair>> near;
        for (const auto& [x, of_x] : a.all)
            for (const auto& [y, of_y] : b.all) {
                if (meet(x, y)) expected.emplace_back(x, y);
                if (distance(x, y) > 0.0) near.push_back({{x, y}, distance(x, y)});
            }
        const tf::transformed first(a.tree, moved ? map : tf::transform<3>{});
        CHECK(tf::search_all(first, b.tree, meet) == expected);
        CHECK(tf::search_any(first, b.tree, meet) == !expected.empty());
        std::sort(near.begin(), near.end(),
                  [](const auto& x, const auto& y) { return nearer(x, y); });
        near.resize(12);
        const auto beyond_zero = [&](std::uint32_t x, std::uint32_t y) {
            const double squared = distance(x, y);
            return squared > 0.0 ? squared : infinity;
        };
        CHECK(tf::k_nearest_pairs(first, b.tree, 12, beyond_zero) == near);
        CHECK(tf::nearest_pair(first, b.tree, beyond_zero) == near[0]);
    }
}

TEST_CASE("dynamic_tree: searches in batches answer as one by one") {
    test::random random(12);
    twin<3> both;
    const boxes<3> source = box_family<3>("random", 600, 13);
    (void)both.insert(source);
    for (int step = 0; step < 6; ++step) both.step(random, source);
    const boxes<3> queries = box_family<3>("random", 300, 14);
    const auto distance = [&](std::size_t query, std::uint32_t id) {
        return squared_between(both.all.at(id), queries[query]);
    };
    const auto nearest = tf::nearest_batch(both.tree, queries, distance);
    const auto three = tf::k_nearest_batch(both.tree, queries, 3, distance);
    const auto within = tf::all_within_batch(both.tree, queries, 0.1, distance);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const auto one = [&](std::uint32_t id) { return distance(i, id); };
        REQUIRE(nearest[i] == tf::nearest(both.tree, queries[i], one));
        REQUIRE(std::ranges::equal(three[i], tf::k_nearest(both.tree, queries[i], 3, one)));
        REQUIRE(std::ranges::equal(within[i], tf::all_within(both.tree, queries[i], 0.1, one)));
    }
}

TEST_CASE("dynamic_tree: a search that asks to stop is not asked again") {
    test::random random(15);
    twin<3> both;
    const boxes<3> source = box_family<3>("random", 600, 16);
    (void)both.insert(source);
    for (int step = 0; step < 6; ++step) both.step(random, source);
    REQUIRE(both.tree.top().size() > 1);
    std::size_t asked = 0;
    tf::search(both.tree, box<3>{{0, 0, 0}, {2, 2, 2}},
               [&](std::uint32_t) { return ++asked == 3; });
    CHECK(asked == 3);
    using pairs = std::vector<tf::id_pair>;
    const auto states =
        tf::search_self<pairs>(both.tree, [](pairs& found, std::uint32_t a, std::uint32_t b) {
            found.emplace_back(a, b);
            return (a + b) % 7 == 3;
        });
    REQUIRE(!states.empty());
    REQUIRE(!states.back().empty());
    CHECK((states.back().back().first + states.back().back().second) % 7 == 3);
}

TEST_CASE("dynamic_tree: after long runs searches open few more nodes than on a fresh tree") {
    test::random random(24);
    const boxes<3> queries = box_family<3>("random", 200, 25);
    const boxes<3> source = box_family<3>("random", 20'000, 26);
    for (const double far : {0.01, 0.1, 10.0}) {  // against neighborhoods of some 0.2
        CAPTURE(far);
        tf::dynamic_tree<3> tree(source, itself);
        for (int batch = 0; batch < 40; ++batch) {
            ids which;
            boxes<3> to;
            const auto first = static_cast<std::uint32_t>(random.below(10));
            for (std::uint32_t id = first; id < 20'000; id += 10) {
                box<3> one = source[id];  // about where it began: the set as a whole stays alike
                for (std::size_t k = 0; k < 3; ++k) {
                    const double step = std::min(far, 1.0) * (random.unit() - 0.5);
                    one.min[k] += step, one.max[k] += step;
                }
                which.push_back(id);
                to.push_back(one);
            }
            tree.move(which, to);
            const auto fresh = nodes_opened(tf::build(all_of(tree), itself), queries);
            REQUIRE(nodes_opened(tree, queries) <= 3 * fresh);
        }
    }
}

TEST_CASE("dynamic_tree: searches refuse what is not sound also where there is nothing") {
    const box<3> unsound{{0, 0, 0}, {1, std::numeric_limits<double>::quiet_NaN(), 1}};
    CHECK_THROWS_AS((void)tf::nearest(tf::dynamic_tree<3>{}, unsound, [](auto) { return 0.0; }),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)tf::any_hit(tf::dynamic_tree<3>{}, tf::ray<double, 3>{{infinity, 0, 0}},
                                      [](auto) { return true; }),
                    std::invalid_argument);
}
