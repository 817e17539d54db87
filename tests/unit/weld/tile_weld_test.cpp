#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/in_tiles.hpp>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using test::border_way;
using test::border_ways;
using test::by_chain;
using test::by_first;
using test::check_equal;
using test::cloud;
using test::number_slices;
using test::tiled;
using test::values_of_points;
using test::weld_crowded;
using test::weld_in_tiles;
using test::weld_tile;
using tf::point3;
using tf::detail::weld::border_point;
using tf::detail::weld::border_weld;
using tf::detail::weld::tile_point;
using tf::detail::weld::tile_result;
using tf::detail::weld::tile_role;

constexpr std::array tile_rules{false, true};

std::vector<std::uint64_t> leaders(const cloud& points, bool chain, double tolerance) {
    const auto groups = tf::group_points(points, {.tolerance = tolerance, .chain = chain});
    std::vector<std::uint64_t> leader;
    for (const std::uint32_t g : groups.group_of_point) leader.push_back(groups.first_of_group[g]);
    return leader;
}

std::size_t in_memory = 0;  ///< points that `tiled_leaders` has done

void check_same(const cloud& points, double tolerance, test::random& random) {
    CAPTURE(tolerance);
    for (const bool chain : tile_rules) {
        const auto expected = leaders(points, chain, tolerance);
        for (const std::size_t count : {1U, 2U, 3U, 7U, 50U}) {
            CAPTURE(chain);
            CAPTURE(count);
            for (int turn = 0; turn < 2; ++turn) {
                border_way way = border_ways[random.below(border_ways.size())];
                way.slices_a_run *= 1 + random.below(4);
                CAPTURE(way.by_halves);
                CAPTURE(way.slices_a_run);
                CAPTURE(way.least_bits);
                CHECK(weld_in_tiles(points, chain, tolerance, count, random, {}, way).leader ==
                      expected);
            }
        }
        if (chain) continue;
        const auto tiled = tf::detail::weld::tiled_leaders(
            points, {.tolerance = tolerance},
            {points.size() / 7 + 1, tf::detail::weld::tiling::always});
        CHECK((tiled.empty() || std::ranges::equal(tiled, expected)));
        in_memory += tiled.size();
    }
}

cloud uniform(std::size_t count, test::random& random) {
    cloud points(count);
    for (point3& p : points) p = {random.unit(), random.unit(), random.unit()};
    return points;
}

}  // namespace

TEST_CASE("tile_weld: an empty cloud and a single point are welded as ever") {
    test::random random(1);
    check_same({}, 0.5, random);
    check_same({{1, 2, 3}}, 0.5, random);
    check_same({{1, 2, 3}, {1, 2, 3}}, 0.0, random);
}

TEST_CASE("tile_weld: a tolerance that is no length is refused") {
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
        CHECK_THROWS_AS(tf::detail::weld::tile_weld(by_first, bad), std::invalid_argument);
        CHECK_THROWS_AS(tf::detail::weld::border_weld{bad}, std::invalid_argument);
        CHECK_THROWS_AS(tf::detail::weld::crowded_chain{bad}, std::invalid_argument);
        CHECK_THROWS_AS(tf::detail::weld::tile_cuts({}, bad, 1), std::invalid_argument);
    }
    CHECK_THROWS_AS(tf::detail::weld::tile_cuts({}, 0.0, 0), std::invalid_argument);
}

TEST_CASE("tile_weld: tiles of random points give the groups of the whole, sparse to dense") {
    test::random random(2);
    const cloud points = uniform(600, random);
    for (const double tolerance : {0.0, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0})
        check_same(points, tolerance, random);
    CHECK(in_memory >= 4 * points.size());  // tiles too small for the tolerance are refused
}

TEST_CASE("tile_weld: tiles of grids, with their many equal distances, give the same groups") {
    test::random random(3);
    for (const double step : {1.0, 0.1}) {
        cloud points;
        for (int i = 0; i < 700; ++i)
            points.push_back({step * static_cast<double>(random.below(9)),
                              step * static_cast<double>(random.below(9)),
                              step * static_cast<double>(random.below(9))});
        for (const double steps : {0.0, 1.0, std::sqrt(2.0), 2.0, 3.0})
            check_same(points, steps * step, random);
    }
}

TEST_CASE("tile_weld: crowds far denser than the tolerance give the same groups") {
    test::random random(4);
    cloud points;
    for (int i = 0; i < 3000; ++i) {
        const double middle = static_cast<double>(random.below(4));
        points.push_back({middle + 0.2 * random.unit(), 0.2 * random.unit(), 0.2 * random.unit()});
    }
    for (const double tolerance : {0.02, 0.1, 0.3, 0.9}) check_same(points, tolerance, random);
}

TEST_CASE("tile_weld: heaps of equal points across a border give the same groups") {
    test::random random(5);
    cloud points;
    for (int i = 0; i < 2000; ++i) {
        const double x = static_cast<double>(random.below(5)) * 0.25;
        points.push_back({random.below(2) == 0 ? x : -x, 0.0, -0.0});
    }
    for (const double tolerance : {0.0, 0.2, 0.25, 0.5, 3.0}) check_same(points, tolerance, random);
}

TEST_CASE("tile_weld: a chain through all tiles is one group, whatever its order") {
    test::random random(6);
    cloud points;
    for (int i = 0; i < 400; ++i) points.push_back({0.5 * i, 0.25 * i, 0.0});
    random.shuffle(points);
    const double step = std::sqrt(0.5 * 0.5 + 0.25 * 0.25);
    check_same(points, 1.01 * step, random);
    check_same(points, 0.99 * step, random);
    const auto leader = weld_in_tiles(points, by_chain, 1.01 * step, 50, random).leader;
    CHECK(std::count(leader.begin(), leader.end(), 0U) == 400);
}

TEST_CASE("tile_weld: decisions that hang on each other from tile to tile come out in order") {
    // Each point is dropped only if the one before it is kept: kept and dropped take turns.
    test::random random(7);
    cloud points;
    for (int i = 0; i < 300; ++i) points.push_back({static_cast<double>(i), 0.0, 0.0});
    const auto leader = weld_in_tiles(points, by_first, 1.0, 40, random).leader;
    for (std::size_t i = 0; i < leader.size(); ++i) CHECK(leader[i] == i - i % 2);
    std::reverse(points.begin(), points.end());
    check_same(points, 1.0, random);
}

TEST_CASE("tile_weld: of rows that hang on those before, a run knows only the last ones") {
    test::random random(17);
    cloud points;
    constexpr std::size_t side = 80;
    for (std::size_t i = 0; i < side * side; ++i)
        points.push_back({static_cast<double>(i % side) + 0.5 * random.unit(),
                          static_cast<double>(i / side) + 0.5 * random.unit(), 0.0});
    const auto expected = leaders(points, by_first, 1.9);
    for (const bool by_halves : {false, true}) {
        const tiled found = weld_in_tiles(points, by_first, 1.9, 9, random, {},
                                          {.by_halves = by_halves, .slices_a_run = 1});
        CHECK(found.leader == expected);
        CHECK(found.border > points.size() / 2);
        // Each of 50 slices asks for about a row; several passes do where halves are settled first.
        CHECK(found.handed_over > 50);
        CHECK(found.handed_over < 50 * side * (by_halves ? 5 : 1));
    }
}

TEST_CASE("tile_weld: rows of small heaps, of which an open point stands for others") {
    test::random random(18);
    for (const double spread : {0.3, 0.6}) {
        cloud points;
        constexpr std::size_t side = 20;
        for (std::size_t site = 0; site < side * side; ++site)
            for (int i = 0; i < 8; ++i)
                points.push_back({0.9 * static_cast<double>(site % side) + spread * random.unit(),
                                  0.9 * static_cast<double>(site / side) + spread * random.unit(),
                                  spread * random.unit()});
        for (const double tolerance : {0.7, 0.9, 1.1}) check_same(points, tolerance, random);
    }
}

TEST_CASE("tile_weld: of a crowd in any order, runs know few points, and each once") {
    test::random random(19);
    cloud points;
    for (int i = 0; i < 20000; ++i)
        points.push_back({random.unit(), 0.3 * random.unit(), 0.3 * random.unit()});
    const auto expected = leaders(points, by_first, 0.2);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) kept += expected[i] == i ? 1 : 0;
    for (const bool by_halves : {false, true}) {
        border_way way{.by_halves = by_halves, .slices_a_run = 1};
        const tiled whole = weld_in_tiles(points, by_first, 0.2, 2, random, {}, way);
        way.least_bits = 0;
        const tiled split = weld_in_tiles(points, by_first, 0.2, 2, random, {}, way);
        CHECK(whole.leader == expected);
        CHECK(split.leader == expected);
        CHECK(whole.handed_over > 0);
        // Of a bundle, only the first run that an open point stands for has something to say of it.
        CHECK(split.handed_over < 2 * whole.handed_over);
        // Each point kept is handed to 63 bundles at most, for each of the few places within a
        // fourth of the tolerance that stand for some of its bundle.
        if (!by_halves) CHECK(whole.handed_over < kept * number_slices::bundles * 8);
    }
}

TEST_CASE("number_slices: all numbers are in one of few slices, in order, and these in bundles") {
    for (const unsigned least_bits : {0U, 3U, number_slices::bits_of_slice})
        for (const std::uint64_t count : {0U, 1U, 63U, 64U, 65U, 128U, 6400U, 6401U, 100000U}) {
            const number_slices slices(count, least_bits);
            std::uint64_t slice = 0;
            std::uint64_t bundle = 0;
            bool in_order = true;
            for (std::uint64_t i = 0; i < count; ++i) {
                if (i == slices.slice_begin(slice + 1)) ++slice;
                if (i == slices.bundle_begin(bundle + 1)) {
                    ++bundle;
                    in_order = in_order && i == slices.slice_begin(slice);
                }
                in_order = in_order && slices.slice_of(i) == slice &&
                           slices.bundle_of(i) == bundle &&
                           slices.bit_of(i) == std::uint64_t{1} << bundle;
            }
            CHECK(in_order);
            CHECK(bundle < number_slices::bundles);
            CHECK(slice < 1024);
            if (slice > bundle) CHECK(slices.slice_begin(1) >= std::uint64_t{1} << least_bits);
        }
    for (const std::uint64_t count : {std::uint64_t{100000000}, std::uint64_t{1} << 62}) {
        const number_slices slices(count);
        CHECK(slices.bundle_of(count - 1) < number_slices::bundles);
        CHECK(slices.slice_of(count - 1) < 1024);
        CHECK(slices.slice_of(count - 1) >= 512);
        CHECK(slices.slice_of(slices.bundle_begin(5)) == 5 * 16);
        CHECK(slices.slice_begin(5 * 16) == slices.bundle_begin(5));
        CHECK(slices.bundle_of(slices.bundle_begin(number_slices::bundles)) ==
              number_slices::bundles);
    }
    CHECK(number_slices(2400000).slice_begin(1) == std::uint64_t{1} << 15);
    CHECK(number_slices().slice_of((std::uint64_t{1} << 62) - 1) == 0);
    CHECK(number_slices().bundle_of((std::uint64_t{1} << 62) - 1) == 0);
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const number_slices small(6400);  // bundles of a slice of 128
    CHECK(small.after(0, 7) == 6);
    CHECK(small.after(62, all) == std::uint64_t{1} << 63);
    CHECK(small.after(63, all) == 0);
    CHECK(small.from(small.bundle_begin(1), 7) == 6);
    CHECK(small.from(small.bundle_begin(64), all) == 0);
    const number_slices split(6400, 0);  // of slices of 8
    CHECK(split.after(1, 7) == 6);
    CHECK(split.after(63, all) == std::uint64_t{1} << 63);
    CHECK(split.from(split.bundle_begin(1), 7) == 6);
    CHECK(split.from(split.bundle_begin(1) + 8, 7) == 6);
}

TEST_CASE("border_weld: an open point is handed over by the one that stands for it") {
    using tf::detail::weld::border_kind;
    const number_slices slices(640);  // of 16 numbers
    const auto open = [](std::uint64_t id, double x) {
        border_point p = border_point::make(id, border_kind::open);
        p.at = {x, 0.0, 0.0};
        return p;
    };
    border_weld earlier(1.0, {}, slices);
    tile_result out;
    earlier.add(open(1, 0.0), {}, true, out);
    earlier.add(open(2, 0.25), {}, true, out);  // the first one stands for it
    std::vector<border_point> known;
    earlier.hand_over({0, {0.5, 0.0, 0.0}, 2}, {},
                      known);  // asked for by one that knows the second
    REQUIRE(known.size() == 1);
    CHECK(known[0].id() == 1);

    border_weld later(1.0, {}, slices);
    later.receive(known[0], {});
    out = {};
    later.add(open(17, 1.25), {}, false, out);  // within the tolerance of the second one only
    REQUIRE(out.border.size() == 1);
    CHECK(out.border[0].kind() == border_kind::open);
    while (later.finish(out)) {
    }
    REQUIRE(out.asked.size() == 1);
    CHECK(out.asked[0].bundle == 0);
    CHECK(out.asked[0].at == point3{0.0, 0.0, 0.0});
    CHECK(out.asked[0].asked_by == 2);
}

TEST_CASE("border_weld: what was received is handed over when it stands for another bundle, too") {
    using tf::detail::weld::border_kind;
    const number_slices slices(640, 0);  // of 1 number, 16 in a bundle
    const auto open = [](std::uint64_t id, double x) {
        border_point p = border_point::make(id, border_kind::open);
        p.at = {x, 0.0, 0.0};
        return p;
    };
    /// What a run that has received `q` and then has `own` hands over.
    const auto after = [&](const border_point& q, const border_point& own) {
        border_weld run(1.0, {}, slices);
        tile_result out;
        run.receive(q, {});
        run.add(own, {}, true, out);
        std::vector<border_point> known;
        run.hand_over({1, own.at, 4}, {}, known);
        return known;
    };
    const auto first = after(open(1, 0.0), open(17, 0.25));
    REQUIRE(first.size() == 1);
    CHECK(first[0].id() == 1);
    CHECK(first[0].leader == 2);
    CHECK(after(first[0], open(18, 0.25)).empty());
    const auto other = after(open(1, 0.0), open(17, 0.5));  // for which it does not stand
    REQUIRE(other.size() == 1);
    CHECK(other[0].id() == 17);
}

TEST_CASE("tile_weld: mixed scales, outliers and the ends of the doubles give the same groups") {
    test::random random(8);
    cloud points;
    for (int i = 0; i < 300; ++i) {
        const double size = std::ldexp(1.0, static_cast<int>(random.below(80)) - 40);
        points.push_back({random.in(-size, size), random.in(-size, size), random.in(-size, size)});
    }
    for (const double tolerance : {1e-12, 1e-3, 1.0, 1e9}) check_same(points, tolerance, random);
    points.resize(40);  // exact comparisons of such lengths take their time
    const double big = std::numeric_limits<double>::max();
    points.push_back({big, big, big});
    points.push_back({-big, -big, -big});
    points.push_back({big, -big, std::nextafter(big, 0.0)});
    points.push_back({big, -big, big});
    for (const double tolerance : {0.0, 1e-300, 1.0, 2e292, 1e301, big})
        check_same(points, tolerance, random);
}

TEST_CASE("tile_weld: denormal coordinates and tolerances give the same groups") {
    test::random random(9);
    constexpr double least = std::numeric_limits<double>::denorm_min();
    cloud points;
    for (int i = 0; i < 500; ++i)
        points.push_back({least * static_cast<double>(random.below(30)),
                          least * static_cast<double>(random.below(4)), 0.0});
    for (const double steps : {0.0, 1.0, 2.0, 3.0, 6.0, 7.0, 14.0, 40.0})
        check_same(points, steps * least, random);
}

TEST_CASE("tile_weld: far from the origin neighboring doubles give the same groups") {
    test::random random(10);
    cloud points;
    for (int i = 0; i < 600; ++i) {
        point3 p{1e6, -1e6, 3e5};
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] += 0x1p-32 * static_cast<double>(random.below(12));
        points.push_back(p);
    }
    for (const double steps : {0.0, 1.0, 2.0, 5.0}) check_same(points, steps * 0x1p-32, random);
}

TEST_CASE("tile_weld: points that are not finite stay out of it") {
    test::random random(11);
    cloud points = uniform(200, random);
    for (std::size_t i = 0; i < points.size(); i += 9)
        points[i].y = i % 2 == 0 ? std::numeric_limits<double>::infinity()
                                 : std::numeric_limits<double>::quiet_NaN();
    check_same(points, 0.2, random);
}

TEST_CASE("tile_weld: the longest move is that from a point to its leader") {
    test::random random(12);
    const cloud points = uniform(500, random);
    for (const bool chain : tile_rules)
        for (const double tolerance : {0.0, 0.05, 0.15, 0.3}) {
            CAPTURE(tolerance);
            const tiled found = weld_in_tiles(points, chain, tolerance, 6, random, {},
                                              border_ways[random.below(border_ways.size())]);
            const auto apart = [&](std::size_t i, double x) {
                const point3& leader = points[found.leader[i]];
                return tf::compare_distance(points[i], leader, {}, {x, 0.0, 0.0});
            };
            std::size_t at_least = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK(apart(i, found.longest) <= 0);
                at_least += apart(i, std::nextafter(found.longest, 0.0)) > 0 ? 1 : 0;
            }
            CHECK((at_least > 0 || found.longest == 0.0));
        }
}

TEST_CASE("tile_weld: what a tile decides for itself does not go to the border") {
    test::random random(13);
    const cloud points = uniform(20000, random);
    const tiled found = weld_in_tiles(points, by_first, 0.005, 4, random);
    CHECK(found.border > 0);
    CHECK(found.border < 2000);
}

TEST_CASE("tile_weld: points whose values do not agree stay apart, as in the whole cloud") {
    test::random random(15);
    constexpr std::uint64_t zero = std::uint64_t{1} << 63;  // the key of 0.0
    for (const double size : {1.0, 0.2}) {
        cloud points = uniform(500, random);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) points[i][k] *= i % 2 == 0 ? 1.0 : size;
        values_of_points more;
        more.agree = tf::detail::weld::agreement({{false, 0.0}, {true, 2.0}});
        for (std::size_t i = 0; i < points.size(); ++i) {
            more.values.push_back(zero + random.below(3));
            more.values.push_back(random.below(6));
        }
        std::vector<std::uint32_t> label;
        for (std::size_t i = 0; i < points.size(); ++i)
            label.push_back(static_cast<std::uint32_t>(more.at(i)[0] - zero));
        for (const bool chain : tile_rules)
            for (const double tolerance : {0.0, 0.05, 0.15, 0.4}) {
                tf::weld_options options{.tolerance = tolerance, .chain = chain, .label = label};
                options.may_merge = [&](std::uint32_t i, std::uint32_t j) {
                    const std::uint64_t a = more.at(i)[1];
                    const std::uint64_t b = more.at(j)[1];
                    return (a < b ? b - a : a - b) <= 2;
                };
                const auto groups = tf::group_points(points, options);
                std::vector<std::uint64_t> expected;
                for (const std::uint32_t g : groups.group_of_point)
                    expected.push_back(groups.first_of_group[g]);
                for (const std::size_t count : {1U, 2U, 7U, 50U})
                    for (const border_way& way : border_ways)
                        CHECK(weld_in_tiles(points, chain, tolerance, count, random, more, way)
                                  .leader == expected);
            }
    }
}

TEST_CASE("tile_cuts: halos of compact tiles do not grow with their count as those of slabs do") {
    test::random random(16);
    const cloud points = uniform(20000, random);
    std::vector<std::uint32_t> halos;
    std::size_t copies = 0;
    const tf::detail::weld::tile_cuts cuts(points, 0.01, 64);
    CHECK(cuts.size() == 64);
    for (const point3& p : points) {
        static_cast<void>(cuts.find(p, halos));
        copies += halos.size();
    }
    // Cubes of side 1/4 have a sixth of the points in halos, and tilted cuts more; 64 slabs all.
    CHECK(copies < points.size() / 3);
}

TEST_CASE("crowded_chain: two crowds a hair more than the tolerance apart stay two") {
    test::random random(14);
    const double gap = 0.5;
    for (const double more : {0.0, 1e-15, 0.01}) {
        std::vector<tile_point> points;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const double side = static_cast<double>(i % 2);
            const double x = 0.1 * static_cast<double>(random.below(5)) / 4.0;
            points.push_back(tile_point::make(
                i, tile_role::own,
                {side > 0.0 ? gap + more + x : -x, 0.1 * random.unit(), i < 2 ? 0.05 : 0.0}));
        }
        points[3998].at = {0.0, 0.0, 0.0};
        points[3999].at = {gap + more, 0.0, 0.0};
        const tile_result result = weld_crowded(points, gap, random);
        CHECK(result.dropped.size() == (more > 0.0 ? 3998 : 3999));
        check_equal(result, weld_tile(points, by_chain, gap, random));
    }
}
