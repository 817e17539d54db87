/// \file
/// Trees over what reaches into a box, against whole trees and against counting one by one.

#include <treeform/tf.hpp>
#include <treeform/tree/build_within.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>
#include <support/extremes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::infinity;
using test::itself;
using ids = std::vector<std::uint32_t>;

template <std::size_t D>
ids sorted_ids(const tf::tree<D>& tree) {
    ids result(tree.ids().begin(), tree.ids().end());
    std::sort(result.begin(), result.end());
    return result;
}

template <std::size_t D>
void check_family(const std::string& name, std::size_t count) {
    const boxes<D> of = box_family<D>(name, count, count);
    for (const std::string& other : test::box_families)
        for (const tf::aabb<double, D>& within : box_family<D>(other, 4, 3)) {
            ids expected;
            for (std::uint32_t i = 0; i < count; ++i)
                if (overlaps(of[i], within)) expected.push_back(i);
            const auto part = tf::build_within(of, itself, within);
            REQUIRE(sorted_ids(part) == expected);
            REQUIRE(tf::search_all(part, within, [&](std::uint32_t id) {
                        return overlaps(of[id], within);
                    }) == expected);
        }
}

/// Boxes moved by `by` along the first axis.
template <std::size_t D>
boxes<D> moved(boxes<D> of, double by) {
    for (auto& box : of) box.min[0] += by, box.max[0] += by;
    return of;
}

}  // namespace

TEST_CASE("build_within: keeps the elements whose boxes meet the box, and no others") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {0U, 1U, 9U, 500U}) {
            CAPTURE(name);
            CAPTURE(count);
            check_family<2>(name, count);
            check_family<3>(name, count);
        }
}

TEST_CASE("build_within: touching counts, an empty box keeps nothing, an infinite one all") {
    const double next = std::nextafter(1.0, 2.0);
    const boxes<2> of{test::box_at<2>({0, 0}, 1.0), test::box_at<2>({next, 0}, 1.0)};
    CHECK(sorted_ids(tf::build_within(of, itself, tf::aabb<double, 2>{{1, 1}, {1, 1}})) == ids{0});
    CHECK(tf::build_within(of, itself, tf::aabb<double, 2>{}).empty());
    const tf::aabb<float, 2> all{{-HUGE_VALF, -HUGE_VALF}, {HUGE_VALF, HUGE_VALF}};
    CHECK(tf::build_within(of, itself, all).size() == 2);
}

TEST_CASE("build_within: with all elements it is the tree of a build") {
    const boxes<3> of = box_family<3>("random", 3000, 1);
    const auto part =
        tf::build_within(of, itself, tf::detail::box_around<3>("treeform::box_of_all", of, itself));
    CHECK(std::ranges::equal(part.ids(), tf::build(of, itself).ids()));
}

TEST_CASE("build_overlap: gives the pairs of whole trees, and skips what cannot be in one") {
    const boxes<3> a = box_family<3>("random", 3000, 2);
    for (const double by : {0.0, 0.9, 1.04, 3.0}) {
        CAPTURE(by);
        const boxes<3> b = moved(box_family<3>("random", 2000, 3), by);
        const auto [part_a, part_b] = tf::build_overlap(a, itself, b, itself);
        const auto exact = [&](std::uint32_t x, std::uint32_t y) { return overlaps(a[x], b[y]); };
        CHECK(tf::search_all(part_a, part_b, exact) == test::overlapping(a, b));
        if (by == 0.9) CHECK(part_a.size() < 1000);
        if (by == 3.0) CHECK((part_a.empty() && part_b.empty()));
    }
    const boxes<3> none;
    CHECK(tf::build_overlap(a, itself, none, itself).first.empty());
    CHECK(tf::build_overlap(none, itself, a, itself).second.empty());
    boxes<3> unsound = a;
    unsound[77].min[0] = infinity;
    CHECK_THROWS_WITH_AS((void)tf::build_overlap(unsound, itself, a, itself),
                         "treeform::build_overlap: the box of element 77 is empty or not finite",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)tf::build_overlap(a, itself, unsound, itself), std::invalid_argument);
}

TEST_CASE("build_within: the same tree on 1, 2 and 8 threads") {
    const boxes<3> of = box_family<3>("random", 60'000, 4);
    const tf::aabb<double, 3> within{{0, 0, 0}, {0.7, 1, 1}};
    const auto ids_on = [&](unsigned threads) {
        const tf::thread_scope scope(threads);
        const auto part = tf::build_within(of, itself, within);
        return ids(part.ids().begin(), part.ids().end());
    };
    const ids serial = ids_on(1);
    CHECK(ids_on(2) == serial);
    CHECK(ids_on(8) == serial);
}

TEST_CASE("build_within: refuses boxes that are not finite, also far off, and names the element") {
    boxes<3> of = box_family<3>("random", 30'000, 5);
    of[20'001].max[1] = infinity;
    of[29'000].min[2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)tf::build_within(of, itself, of[0]),
                         "treeform::build_within: the box of element 20001 is empty or not finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)tf::detail::box_around<3>("treeform::box_of_all", of, itself),
                         "treeform::box_of_all: the box of element 20001 is empty or not finite",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)tf::build_within(boxes<3>{}, itself, of[29'000]), std::invalid_argument);
}

TEST_CASE("common_box: is what both hold, a point where they touch, empty where they do not meet") {
    using box = tf::aabb<double, 2>;
    CHECK(tf::common_box(box{{0, 0}, {2, 2}}, box{{1, -1}, {3, 1}}) == box{{1, 0}, {2, 1}});
    CHECK(tf::common_box(box{{0, 0}, {1, 1}}, box{{1, 1}, {2, 2}}) == box{{1, 1}, {1, 1}});
    CHECK(tf::common_box(box{{0, 0}, {1, 1}}, box{{2, 0}, {3, 1}}).empty());
}
