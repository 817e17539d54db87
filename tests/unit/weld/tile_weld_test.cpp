#include <libmesh/weld/crowded_chain.hpp>
#include <libmesh/weld/dense.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
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

using tf::point3;
using tf::weld_rule;
using tf::detail::weld::border_point;
using tf::detail::weld::tile_drop;
using tf::detail::weld::tile_point;
using tf::detail::weld::tile_role;
using cloud = std::vector<point3>;

constexpr std::array rules{weld_rule::first, weld_rule::chain};

bool finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

struct tiled {
    std::vector<std::uint64_t> leader;
    double longest = 0.0;
    std::size_t border = 0;
};

std::vector<std::vector<tile_point>> scatter(const cloud& points,
                                             const tf::detail::weld::tile_cuts& cuts) {
    std::vector<std::vector<tile_point>> tiles(cuts.size());
    std::vector<std::uint32_t> halos;
    bool in_range = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!finite(points[i])) continue;
        const std::uint32_t own = cuts.find(points[i], halos);
        in_range = in_range && own < cuts.size();
        tiles[own].push_back(
            tile_point::make(i, halos.empty() ? tile_role::own : tile_role::shared, points[i]));
        for (const std::uint32_t t : halos) {
            in_range = in_range && t < cuts.size() && t != own;
            tiles[t].push_back(tile_point::make(i, tile_role::halo, points[i]));
        }
    }
    REQUIRE(in_range);
    return tiles;
}

/// Calls `take` for all of `points`, in blocks of any size.
template <class Take>
void in_blocks(const std::vector<tile_point>& points, test::random& random, const Take& take) {
    for (std::size_t begin = 0; begin < points.size();) {
        const std::size_t size = std::min(points.size() - begin, 1 + random.below(points.size()));
        take(std::span(points).subspan(begin, size));
        begin += size;
    }
}

/// What must agree, and the values of all points.
struct values_of_points {
    tf::detail::weld::agreement agree{};
    std::vector<std::uint64_t> values{};

    [[nodiscard]] const std::uint64_t* at(std::uint64_t id) const {
        return values.data() + id * agree.size();
    }
    [[nodiscard]] std::vector<std::uint64_t> of(std::span<const tile_point> points) const {
        std::vector<std::uint64_t> all;
        for (const tile_point& p : points)
            all.insert(all.end(), at(p.id()), at(p.id()) + agree.size());
        return all;
    }
};

tf::detail::weld::tile_result weld_tile(const std::vector<tile_point>& points, weld_rule rule,
                                        double tolerance, test::random& random,
                                        const values_of_points& more = {}) {
    tf::detail::weld::tile_weld tile(rule, tolerance, more.agree);
    tf::detail::weld::tile_result result;
    in_blocks(points, random, [&](auto block) { tile.add(block, result, more.of(block)); });
    while (tile.finish(result)) {
    }
    return result;
}

tf::detail::weld::tile_result weld_crowded(const std::vector<tile_point>& points, double tolerance,
                                           test::random& random) {
    tf::detail::weld::crowded_chain tile(tolerance);
    tf::detail::weld::tile_result result;
    in_blocks(points, random, [&](auto block) { tile.look(block); });
    in_blocks(points, random, [&](auto block) { tile.link(block); });
    in_blocks(points, random, [&](auto block) { tile.settle(block, result); });
    return result;
}

void check_equal(const tf::detail::weld::tile_result& a, const tf::detail::weld::tile_result& b) {
    const auto same_member = [](const auto& p, const auto& q) {
        return p.at == q.at && p.lowest == q.lowest && p.lowest_at == q.lowest_at;
    };
    const auto same_border = [&](const border_point& p, const border_point& q) {
        return p.tag == q.tag && p.at == q.at && p.leader == q.leader && p.leader_at == q.leader_at;
    };
    CHECK(a.dropped == b.dropped);
    CHECK(std::ranges::equal(a.border, b.border, same_border));
    CHECK(std::ranges::equal(a.members, b.members, same_member));
    CHECK(a.move.length() == b.move.length());
}

/// What tiles [first, last) leave to others: by one pass, or by one over what two passes leave, each
/// over a half of them, and so on.
struct passes {
    weld_rule rule;
    double tolerance;
    const tf::detail::weld::tile_cuts& cuts;
    const std::vector<tf::detail::weld::tile_result>& tiles;
    const values_of_points& more;
    bool one_by_one = false;
    std::vector<tile_drop> dropped{};
    tf::detail::weld::longest_move longest{};
    tf::detail::weld::border_weld joined{0.0};  ///< by all passes

    std::vector<border_point> over(std::size_t first, std::size_t last) {
        std::vector<border_point> border;
        if (one_by_one && last - first > 1) {
            const std::size_t middle = (first + last) / 2;
            border = over(first, middle);
            const std::vector<border_point> rest = over(middle, last);
            border.insert(border.end(), rest.begin(), rest.end());
        } else {
            for (std::size_t t = first; t < last; ++t)
                border.insert(border.end(), tiles[t].border.begin(), tiles[t].border.end());
        }
        std::ranges::stable_sort(border, {}, &border_point::id);
        tf::detail::weld::border_weld pass(tolerance, more.agree);
        tf::detail::weld::tile_result out;
        std::vector<std::uint32_t> halos;
        const auto is_outer = [&](const border_point& p) {
            const auto is_other = [&](std::uint32_t t) { return t < first || t >= last; };
            return is_other(cuts.find(p.at, halos)) || std::ranges::any_of(halos, is_other);
        };
        for (const border_point& p : border)
            pass.add(p, {more.at(p.id()), more.agree.size()}, is_outer(p), out);
        for (const border_point& link : pass.joined()) {
            out.dropped.push_back({link.id(), link.leader});
            joined.join(link);
        }
        if (rule == weld_rule::chain)
            for (const border_point& p : border)
                if (is_outer(p)) out.border.push_back(pass.handed_on(p));
        dropped.insert(dropped.end(), out.dropped.begin(), out.dropped.end());
        longest.consider(out.move);
        return out.border;
    }
};

/// The leader of each point by `count` tiles, done in an order of `random`, in blocks of any size.
tiled weld_in_tiles(const cloud& points, weld_rule rule, double tolerance, std::size_t count,
                    test::random& random, const values_of_points& more = {},
                    bool one_by_one = false) {
    cloud sample;
    std::copy_if(points.begin(), points.end(), std::back_inserter(sample), finite);
    const tf::detail::weld::tile_cuts planned(sample, tolerance, count);
    const tf::detail::weld::tile_cuts slabs({planned.nodes().begin(), planned.nodes().end()},
                                            tolerance);
    const auto tiles = scatter(points, slabs);
    std::vector<std::size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);

    tiled all;
    all.leader.resize(points.size());
    std::iota(all.leader.begin(), all.leader.end(), std::uint64_t{0});
    tf::detail::weld::longest_move longest;
    std::vector<tile_drop> dropped;
    std::vector<tf::detail::weld::tile_member> members;
    std::vector<tf::detail::weld::tile_result> results(tiles.size());
    for (const std::size_t t : order) {
        const tf::detail::weld::tile_result& result = results[t] =
            weld_tile(tiles[t], rule, tolerance, random, more);
        if (rule == weld_rule::first)
            REQUIRE(result.border_values.size() == result.border.size() * more.agree.size());
        if (rule == weld_rule::chain && tiles.size() <= 3 && more.agree.size() == 0)
            check_equal(result, weld_crowded(tiles[t], tolerance, random));
        const auto by_id = [](const auto& a, const auto& b) { return a < b; };
        REQUIRE(std::is_sorted(result.dropped.begin(), result.dropped.end(),
                               [&](auto& a, auto& b) { return by_id(a.id, b.id); }));
        REQUIRE(std::is_sorted(result.border.begin(), result.border.end(),
                               [&](auto& a, auto& b) { return by_id(a.id(), b.id()); }));
        dropped.insert(dropped.end(), result.dropped.begin(), result.dropped.end());
        all.border += result.border.size();
        members.insert(members.end(), result.members.begin(), result.members.end());
        longest.consider(result.move);
    }

    passes pass{rule, tolerance, slabs, results, more, one_by_one};
    REQUIRE(pass.over(0, tiles.size()).empty());
    longest.consider(pass.longest);
    for (const tf::detail::weld::tile_member& m : members) pass.joined.measure(m, longest);
    all.longest = longest.length();
    for (const tile_drop& d : dropped) all.leader[d.id] = pass.joined.leader_of(d.leader);
    bool agree = true;  // where a point is named twice
    for (const tile_drop& d : pass.dropped) {
        const std::uint64_t leader = pass.joined.leader_of(d.leader);
        agree = agree && (all.leader[d.id] == d.id || all.leader[d.id] == leader);
        all.leader[d.id] = leader;
    }
    REQUIRE(agree);
    return all;
}

std::vector<std::uint64_t> leaders(const cloud& points, weld_rule rule, double tolerance) {
    const auto groups = tf::group_points(points, {.tolerance = tolerance, .rule = rule});
    std::vector<std::uint64_t> leader;
    for (const std::uint32_t g : groups.group_of_point) leader.push_back(groups.first_of_group[g]);
    return leader;
}

std::size_t in_memory = 0;  ///< points that `tiled_leaders` has done

void check_same(const cloud& points, double tolerance, test::random& random) {
    CAPTURE(tolerance);
    for (const weld_rule rule : rules) {
        const auto expected = leaders(points, rule, tolerance);
        for (const std::size_t count : {1U, 2U, 3U, 7U, 50U}) {
            CAPTURE(static_cast<int>(rule));
            CAPTURE(count);
            for (const bool one_by_one : {false, true})
                CHECK(
                    weld_in_tiles(points, rule, tolerance, count, random, {}, one_by_one).leader ==
                    expected);
        }
        if (rule != weld_rule::first) continue;
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
        CHECK_THROWS_AS(tf::detail::weld::tile_weld(weld_rule::first, bad), std::invalid_argument);
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
    const auto leader = weld_in_tiles(points, weld_rule::chain, 1.01 * step, 50, random).leader;
    CHECK(std::count(leader.begin(), leader.end(), 0U) == 400);
}

TEST_CASE("tile_weld: decisions that hang on each other from tile to tile come out in order") {
    // Each point is dropped only if the one before it is kept: kept and dropped take turns.
    test::random random(7);
    cloud points;
    for (int i = 0; i < 300; ++i) points.push_back({static_cast<double>(i), 0.0, 0.0});
    const auto leader = weld_in_tiles(points, weld_rule::first, 1.0, 40, random).leader;
    for (std::size_t i = 0; i < leader.size(); ++i) CHECK(leader[i] == i - i % 2);
    std::reverse(points.begin(), points.end());
    check_same(points, 1.0, random);
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
    for (const double steps : {0.0, 1.0, 2.0, 3.0, 7.0, 40.0})
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
    for (const weld_rule rule : rules)
        for (const double tolerance : {0.0, 0.05, 0.15, 0.3}) {
            CAPTURE(tolerance);
            const tiled found =
                weld_in_tiles(points, rule, tolerance, 6, random, {}, random.below(2) == 1);
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
    const tiled found = weld_in_tiles(points, weld_rule::first, 0.005, 4, random);
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
        for (const weld_rule rule : rules)
            for (const double tolerance : {0.0, 0.05, 0.15, 0.4}) {
                tf::weld_options options{.tolerance = tolerance, .rule = rule, .label = label};
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
                    for (const bool one_by_one : {false, true})
                        CHECK(
                            weld_in_tiles(points, rule, tolerance, count, random, more, one_by_one)
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
        const tf::detail::weld::tile_result result = weld_crowded(points, gap, random);
        CHECK(result.dropped.size() == (more > 0.0 ? 3998 : 3999));
        check_equal(result, weld_tile(points, weld_rule::chain, gap, random));
    }
}
