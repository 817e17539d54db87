/// \file
/// Search by a box and by whatever can be held against one, against all primitives one by one.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::box_family;
using test::boxes;
using test::itself;
using ids = std::vector<std::uint32_t>;

template <std::size_t D>
ids wanted(const boxes<D>& of, const auto& query) {
    ids result;
    for (std::uint32_t i = 0; i < of.size(); ++i)
        if (query(of[i])) result.push_back(i);
    return result;
}

template <std::size_t D>
void check_boxes(const std::string& name, std::size_t count) {
    const boxes<D> of = box_family<D>(name, count, count);
    const auto tree = tf::build(of, itself);
    for (const std::string& other : test::box_families)
        for (const tf::aabb<double, D>& query : box_family<D>(other, 12, 5)) {
            CAPTURE(other);
            const auto overlap = [&](const tf::aabb<double, D>& box) {
                return overlaps(box, query);
            };
            const auto exact = [&](std::uint32_t id) { return overlap(of[id]); };
            const ids expected = wanted(of, overlap);
            REQUIRE(tf::search_all(tree, query, exact) == expected);
            REQUIRE(tf::search_all(tree, overlap, exact) == expected);
            REQUIRE(tf::search_any(tree, query, exact) == !expected.empty());
        }
}

/// Within a distance of a point: a query that is no box.
struct ball {
    std::array<double, 3> center;
    double radius;

    bool operator()(const tf::aabb<double, 3>& box) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double off = std::max({box.min[k] - center[k], center[k] - box.max[k], 0.0});
            sum += off * off;
        }
        return sum <= radius * radius;
    }
};

}  // namespace

TEST_CASE("search: finds what brute force finds, by box and by check, in 3D") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {0UL, 1UL, 9UL, 700UL}) {
            CAPTURE(name);
            CAPTURE(count);
            check_boxes<3>(name, count);
        }
}
TEST_CASE("search: finds what brute force finds, by box and by check, in 2D") {
    for (const std::string& name : test::box_families)
        for (const std::size_t count : {1UL, 8UL, 300UL}) {
            CAPTURE(name);
            CAPTURE(count);
            check_boxes<2>(name, count);
        }
}

TEST_CASE("search: a check may be any query") {
    const boxes<3> of = box_family<3>("random", 20'000, 1);
    const auto tree = tf::build(of, itself);
    const ball query{{0.4, 0.5, 0.6}, 0.2};
    ids found;
    const tf::search_statistics seen =
        tf::search(tree, query, [&](std::uint32_t id) { found.push_back(id); });
    std::sort(found.begin(), found.end());
    CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
    CHECK(seen.candidates == found.size());
    CHECK(seen.nodes < 20'000 / 8 / 4);
    std::erase_if(found, [&](std::uint32_t id) { return !query(of[id]); });
    CHECK(found == wanted(of, query));
}

TEST_CASE("search: a box of float finds what it finds as a box of double") {
    const auto tree = tf::build(box_family<2>("random", 5'000, 2), itself);
    const tf::aabb<float, 2> narrow{{0.25F, 0.5F}, {0.375F, 0.75F}};
    const tf::aabb<double, 2> wide{{0.25, 0.5}, {0.375, 0.75}};
    CHECK(!tf::search_all(tree, narrow).empty());
    CHECK(tf::search_all(tree, narrow) == tf::search_all(tree, wide));
}

TEST_CASE("search: comes in leaf order and ends where it is told to") {
    const auto tree = tf::build(box_family<3>("grid", 4'000, 3), itself);
    const tf::aabb<double, 3> query{{0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}};
    ids place_of(tree.size()), places;
    for (std::uint32_t place = 0; place < tree.size(); ++place) place_of[tree.ids()[place]] = place;
    tf::search(tree, query, [&](std::uint32_t id) { places.push_back(place_of[id]); });
    REQUIRE(places.size() > 100);
    CHECK(std::is_sorted(places.begin(), places.end()));
    ids first;
    tf::search(tree, query, [&](std::uint32_t id) {
        first.push_back(place_of[id]);
        return first.size() == 10;
    });
    CHECK(first == ids(places.begin(), places.begin() + 10));
}

TEST_CASE("search_broad: hands out the same primitives a leaf block at a time") {
    const auto tree = tf::build(box_family<3>("random", 4'000, 4), itself);
    const tf::aabb<double, 3> query{{0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}};
    ids one_by_one, in_blocks;
    tf::search(tree, query, [&](std::uint32_t id) { one_by_one.push_back(id); });
    tf::search_broad(tree, query, [&](std::span<const std::uint32_t> block) {
        CHECK(block.size() >= 1);
        CHECK(block.size() <= 8);
        in_blocks.insert(in_blocks.end(), block.begin(), block.end());
        return false;
    });
    CHECK(in_blocks == one_by_one);
}

TEST_CASE("search: touching counts; an empty box finds nothing, an infinite one everything") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double next = std::nextafter(1.0, 2.0);
    const boxes<2> of{test::box_at<2>({0, 0}, 1.0), test::box_at<2>({next, 0}, 1.0)};
    const auto tree = tf::build(of, itself);
    const tf::aabb<double, 2> beside{{1.0, 0.0}, {1.0, 0.0}};
    CHECK(tf::search_all(tree, beside,
                         [&](std::uint32_t id) { return overlaps(of[id], beside); }) == ids{0});
    CHECK(tf::search_all(tree, tf::aabb<double, 2>{}).empty());
    CHECK(tf::search_all(tree, tf::aabb<double, 2>{{-infinity, -infinity}, {infinity, infinity}}) ==
          ids{0, 1});
    CHECK(tf::search_all(tf::tree<2>{}, beside).empty());
}

TEST_CASE("search: refuses a box with a coordinate that is NaN") {
    const auto tree = tf::build(box_family<2>("random", 5, 5), itself);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)tf::search_all(tree, tf::aabb<double, 2>{{0, nan}, {1, 1}}),
                    std::invalid_argument);
}
