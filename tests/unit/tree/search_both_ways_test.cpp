/// \file
/// Pairs of two trees of which one is moved, their boxes compared in the frames of both.

#include <treeform/tf.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search_pair.hpp>

#include <doctest/doctest.h>
#include <support/box_families.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace {

using test::box_family;
using test::boxes;
using test::id_pairs;
using test::itself;

constexpr bool upright = false;  // only in one frame

template <std::size_t D>
id_pairs pairs_of(const tf::transformed<D>& a, const tf::transformed<D>& b,
                  bool in_both_frames = true) {
    id_pairs pairs;
    const auto add = [&](const tf::candidate_block& block) {
        for (std::size_t i = 0; i < block.first.size(); ++i)
            pairs.emplace_back(a.original().ids()[block.first[i]],
                               b.original().ids()[block.second[i]]);
        return true;
    };
    const tf::pair_search_chunks<D> search(a, b, in_both_frames);
    for (std::size_t chunk = 0; chunk < search.chunks(); ++chunk) search.visit(chunk, add);
    const id_pairs cut = pairs;
    pairs.clear();
    tf::pair_search_chunks<D>::visit_all(a, b, add, in_both_frames);
    REQUIRE(pairs == cut);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// A turn in two planes, times `scale`, then a move.
template <std::size_t D>
tf::transform<D> turned(test::random& source, double scale, double reach) {
    const auto in_plane = [&](std::size_t j, std::size_t k) {
        const double angle = source.in(0.0, 2 * std::numbers::pi);
        tf::transform<D> by;
        by.rows[j][j] = by.rows[k][k] = std::cos(angle);
        by.rows[j][k] = -std::sin(angle);
        by.rows[k][j] = std::sin(angle);
        return by;
    };
    tf::transform<D> by = in_plane(0, 1).after(in_plane(D - 2, D - 1));
    for (auto& row : by.rows) {
        for (double& entry : row) entry *= scale;
        row[D] = source.in(-reach, reach);
    }
    return by;
}

template <std::size_t D>
tf::transform<D> map_of(test::random& source, std::uint64_t seed) {
    switch (seed % 8) {
        case 0:
            return turned<D>(source, 1.0, 1e9);
        case 1:
            return turned<D>(source, 1e-12, 1.0);
        case 2:
            return turned<D>(source, 1e25, 1e30);
        case 3:
            return turned<D>(source, -1.0, 3.0);
        default:
            break;
    }
    tf::transform<D> map = turned<D>(source, 1.0, 1.0);
    if (seed % 8 > 4)
        for (auto& row : map.rows)
            for (double& entry : row) entry = source.in(-1, 1);
    if (seed % 8 == 6) map.rows[1] = map.rows[0];  // singular
    if (seed % 8 == 7)                             // nearly so
        for (std::size_t j = 0; j < D; ++j)
            map.rows[1][j] = map.rows[0][j] * (1.0 + 1e-13 * source.in(-1, 1));
    return map;
}

/// Boxes of `a` and `b` with the same number hold a point and its image.
template <std::size_t D>
void check_points_that_meet(double scale, double shift, bool wide) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto by = map_of<D>(source, seed);
        boxes<D> a, b;
        for (const auto& box : box_family<D>(test::box_families[seed % 6], 200, seed)) {
            std::array<double, D> point = box.min;
            for (double& x : point) x = x * scale + shift;
            const auto image = by(point);
            tf::aabb<double, D> of_point, of_image;
            of_point.include(point);
            of_image.include(image);
            for (std::size_t k = 0; k < D && wide; ++k) {
                of_point.min[k] -= scale * source.in(0, 0.1);
                of_image.max[k] += scale * source.in(0, 0.1);
            }
            b.push_back(of_point);
            a.push_back(of_image);
        }
        const auto tree_a = tf::build(a, itself);
        const auto tree_b = tf::build(b, itself);
        const auto moved_second = pairs_of<D>(tree_a, {tree_b, by});
        const auto moved_first = pairs_of<D>({tree_b, by}, tree_a);
        for (std::uint32_t i = 0; i < a.size(); ++i) {
            REQUIRE(std::binary_search(moved_second.begin(), moved_second.end(), std::pair{i, i}));
            REQUIRE(std::binary_search(moved_first.begin(), moved_first.end(), std::pair{i, i}));
        }
    }
}

template <std::size_t D>
void check_upright_ones() {
    std::size_t fewer = 0, more = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const auto tree_a = tf::build(box_family<D>("random", 3000, seed), itself);
        const auto tree_b = tf::build(box_family<D>("random", 2000, seed + 1), itself);
        const auto by = turned<D>(source, 1.0, 0.2);
        const auto some = pairs_of<D>(tree_a, {tree_b, by});
        const auto all = pairs_of<D>(tree_a, {tree_b, by}, upright);
        CHECK(std::includes(all.begin(), all.end(), some.begin(), some.end()));
        fewer += some.size();
        more += all.size();
    }
    CHECK(fewer > 100);
    CHECK(fewer < more - more / 20);
}

}  // namespace

TEST_CASE("search both ways: pairs with a point in common are found, whatever the map, in 3D") {
    for (const double scale : {1.0, 1e-9, 0x1p200, 0x1p-900, 0x1p900})
        for (const bool wide : {false, true}) {
            CAPTURE(scale);
            CAPTURE(wide);
            check_points_that_meet<3>(scale, 0.0, wide);
            check_points_that_meet<3>(scale, 1e9 * scale, wide);
        }
}
TEST_CASE("search both ways: pairs with a point in common are found, whatever the map, in 2D") {
    for (const bool wide : {false, true}) check_points_that_meet<2>(1.0, 0.5, wide);
}

TEST_CASE("search both ways: fewer pairs than upright, and all of them upright ones") {
    check_upright_ones<3>();
    check_upright_ones<2>();
}

TEST_CASE("search both ways: upright where nothing is turned, or both trees are moved") {
    test::random source(1);
    const auto tree_a = tf::build(box_family<3>("random", 2000, 1), itself);
    const auto tree_b = tf::build(box_family<3>("grid", 2000, 2), itself);
    const auto same = [&](const tf::transform<3>& by_a, const tf::transform<3>& by_b) {
        const tf::transformed<3> a(tree_a, by_a), b(tree_b, by_b);
        return pairs_of<3>(a, b) == pairs_of<3>(a, b, upright);
    };
    const auto moved = tf::transform<3>::translation(std::array{0.25, 0.5, 1e-3});
    CHECK(same({}, {}));
    CHECK(same({}, moved));
    CHECK(same(moved, {}));
    CHECK(same(turned<3>(source, 1.0, 0.1), turned<3>(source, 1.0, 0.1)));
    CHECK(pairs_of<3>(tf::tree<3>{}, {tree_b, turned<3>(source, 1.0, 0.1)}).empty());
    CHECK(pairs_of<3>(tree_a, {tf::tree<3>{}, turned<3>(source, 1.0, 0.1)}).empty());
}

TEST_CASE("search both ways: trees of very different sizes") {
    test::random source(2);
    for (const std::size_t m : {1U, 7U, 9U, 100U, 5000U})
        for (const std::size_t n : {1U, 8U, 70U, 600U}) {
            CAPTURE(m);
            CAPTURE(n);
            const boxes<3> a = box_family<3>("random", m, m), b = box_family<3>("random", n, n + 1);
            const auto by = turned<3>(source, 1.0, 0.3);
            const auto tree_a = tf::build(a, itself), tree_b = tf::build(b, itself);
            const auto pairs = pairs_of<3>(tree_a, {tree_b, by});
            // A corner of a box of b, moved, in a box of a.
            for (std::uint32_t j = 0; j < b.size(); ++j) {
                tf::aabb<double, 3> corner;
                corner.include(by(b[j].min));
                for (std::uint32_t i = 0; i < a.size(); ++i) {
                    if (!overlaps(a[i], corner)) continue;
                    REQUIRE(std::binary_search(pairs.begin(), pairs.end(), std::pair{i, j}));
                }
            }
        }
}
