/// \file
/// Sets of boxes that change: ids, slots, what an update costs, what is refused.

#include <treeform/tf.hpp>
#include <treeform/tree/dynamic_tree.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::itself;
using tf::detail::update_counts;
using ids = std::vector<std::uint32_t>;

template <std::size_t D>
using box = tf::aabb<double, D>;

}  // namespace

TEST_CASE("dynamic_tree: boxes of floats are taken as they are") {
    using floats = tf::aabb<float, 2>;
    tf::dynamic_tree<2> scene;
    CHECK(scene.insert(std::vector{floats{{0, 0}, {1, 1}}, floats{{2, 0}, {3, 1}}}) == ids{0, 1});
    scene.move(ids{1}, std::vector{floats{{5, 0}, {6, 1}}});
    CHECK(scene.box(1) == box<2>{{5, 0}, {6, 1}});
}

TEST_CASE("dynamic_tree: ids stay, and those of removed ones are given out again, last first") {
    const boxes<3> source = box_family<3>("random", 100, 2);
    tf::dynamic_tree<3> tree(source, itself);
    CHECK(tree.id_end() == 100);
    tree.remove(ids{7, 90, 30});
    CHECK(tree.size() == 97);
    CHECK(!tree.contains(90));
    CHECK(tree.box(91) == source[91]);
    CHECK(tree.insert(std::span(source).first(4)) == ids{30, 90, 7, 100});
    CHECK(tree.box(90) == source[1]);
}

TEST_CASE("dynamic_tree: a small move stays in its slot, a large one leaves it") {
    tf::dynamic_tree<3> tree(box_family<3>("random", 5000, 3), itself);
    const auto built = update_counts::of(tree).built;
    box<3> near = tree.box(17), far = tree.box(18);
    near.min[0] += 1e-4;
    far.min[0] += 100.0, far.max[0] += 100.0;
    tree.move(ids{17}, std::span(&near, 1));
    CHECK(update_counts::of(tree).refitted == 1);
    CHECK(update_counts::of(tree).built == built);
    tree.move(ids{18}, std::span(&far, 1));
    CHECK(update_counts::of(tree).refitted == 1);
    CHECK(update_counts::of(tree).vacated == 1);
    CHECK(update_counts::of(tree).built == built + 1);
    CHECK(tree.top().size() == 2);
}

TEST_CASE("dynamic_tree: the same trees, ids and pairs on 1, 2 and 8 threads") {
    const auto run_on = [](unsigned threads) {
        const tf::thread_scope scope(threads);
        test::random random(17);
        const boxes<3> source = box_family<3>("random", 20'000, 18);
        tf::dynamic_tree<3> tree(box_family<3>("random", 40'000, 19), itself);
        ids which(18'000);
        for (std::uint32_t i = 0; i < which.size(); ++i) which[i] = 2 * i;
        boxes<3> to(which.size());
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] = tree.box(which[i]);
            if (i % 3 == 0) to[i] = source[i];
        }
        tree.move(which, to);
        tree.remove(std::span(which).subspan(5000, 4000));
        (void)tree.insert(source);
        ids result;
        for (const std::uint32_t part : tree.top().ids()) {
            const auto in_order = tree.part(part).ids();
            result.insert(result.end(), in_order.begin(), in_order.end());
        }
        const auto& cost = update_counts::of(tree);
        for (const std::uint64_t count : {cost.built, cost.refitted, cost.vacated})
            result.push_back(static_cast<std::uint32_t>(count));
        using pairs = std::vector<tf::id_pair>;
        for (const pairs& found :
             tf::search_self<pairs>(tree, [](pairs&all, std::uint32_t a, std::uint32_t b) {
                 if (all.size() < 50) all.emplace_back(a, b);
             }))
            for (const auto& [a, b] : found) result.push_back(a), result.push_back(b);
        return result;
    };
    const ids serial = run_on(1);
    CHECK(run_on(2) == serial);
    CHECK(run_on(8) == serial);
}

TEST_CASE("dynamic_tree: builds cost what the documentation says, one by one and in batches") {
    test::random random(20);
    const boxes<3> source = box_family<3>("random", 3000, 21);
    tf::dynamic_tree<3> tree;
    std::uint64_t inserted = 0, removed = 0;
    const auto bound = [&] {
        const double each = 64.0 + 3.2 * std::log2(static_cast<double>(tree.id_end() + 1));
        return each * static_cast<double>(inserted) + 5.0 * static_cast<double>(removed);
    };
    for (const box<3>& one : source) {
        const ids given = tree.insert(std::span(&one, 1));
        ++inserted;
        if (random.below(3) == 0) {
            tree.remove(given);
            ++removed;
        }
        REQUIRE(static_cast<double>(update_counts::of(tree).built) <= bound());
    }
    ids there;
    for (std::uint32_t id = 0; id < tree.id_end(); ++id)
        if (tree.contains(id)) there.push_back(id);
    random.shuffle(there);
    for (const std::uint32_t id : there) {
        tree.remove(std::span(&id, 1));
        ++removed;
        REQUIRE(static_cast<double>(update_counts::of(tree).built) <= bound());
    }
    // Batches of a tenth that go anywhere: with each third one all is built.
    tf::dynamic_tree<3> large(box_family<3>("random", 10'000, 22), itself);
    const auto before = update_counts::of(large).built;
    for (std::uint32_t batch = 0; batch < 30; ++batch) {
        ids which;
        for (std::uint32_t id = 0; id < 1000; ++id) which.push_back(id * 10 + batch % 10);
        large.move(which, box_family<3>("random", 1000, 23 + batch), itself);
    }
    CHECK(update_counts::of(large).built - before <= 30 * 10'000 / 2);
}

TEST_CASE("dynamic_tree: refuses ids that are not there or come twice, and boxes, naming them") {
    tf::dynamic_tree<3> tree(box_family<3>("random", 1000, 27), itself);
    tree.remove(ids{5});
    const box<3> sound = tree.box(0);
    box<3> unsound = sound;
    unsound.max[1] = std::numeric_limits<double>::quiet_NaN();
    const auto before = update_counts::of(tree);
    CHECK_THROWS_WITH_AS(tree.remove(ids{1, 5}),
                         "treeform::dynamic_tree: cannot remove id 5, which is not in the tree",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(tree.remove(ids{1000}),
                         "treeform::dynamic_tree: cannot remove id 1000, which is not in the tree",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(tree.remove(ids{3, 8, 3}),
                         "treeform::dynamic_tree: cannot remove id 3 twice", std::invalid_argument);
    ids many;
    for (std::uint32_t id = 10; id < 900; ++id) many.push_back(id);
    many.push_back(77);
    CHECK_THROWS_WITH_AS(tree.remove(many), "treeform::dynamic_tree: cannot remove id 77 twice",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(tree.move(ids{1, 5}, boxes<3>{sound, sound}),
                         "treeform::dynamic_tree: cannot move id 5, which is not in the tree",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(tree.move(ids{1, 9}, boxes<3>{sound, unsound}),
                         "treeform::dynamic_tree: the box of id 9 is empty or not finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(tree.move(ids{1, 9}, boxes<3>{sound}),
                         "treeform::dynamic_tree: 2 ids but 1 boxes", std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tree.insert(boxes<3>{sound, sound, unsound}),
                         "treeform::dynamic_tree: the box of element 2 is empty or not finite",
                         std::invalid_argument);
    CHECK(update_counts::of(tree) == before);
    CHECK(tree.size() == 999);
    CHECK(tree.box(1) != sound);
}
