/// \file
/// Welding in the order of a property, against the rules' definitions on points put in that order.

#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/brute_weld.hpp>
#include <support/columns.hpp>
#include <support/extremes.hpp>
#include <support/random.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using test::infinity;
using test::not_a_number;
using test::vertex_columns;
using ids = std::vector<std::uint32_t>;

/// By plain comparisons.
ids in_order(const std::vector<double>& values, bool lowest) {
    ids order(values.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        const double a = values[i];
        const double b = values[j];
        if (std::isnan(a) || std::isnan(b)) return !std::isnan(a);
        return lowest ? a < b : a > b;
    });
    return order;
}

/// The survivor that each point belongs to, `linked` being of points as they are numbered.
template <class Linked>
ids survivors(const tf::mesh& cloud, const ids& order, bool chain, const Linked& linked) {
    std::vector<tf::point3> sorted;
    for (const std::uint32_t i : order) sorted.push_back(cloud.points[i]);
    const auto sorted_linked = [&](std::uint32_t i, std::uint32_t j) {
        return linked(order[i], order[j]);
    };
    const ids first = !chain ? tf::test::brute_leaders(sorted, sorted_linked)
                             : tf::test::brute_chains(sorted, sorted_linked);
    ids survivor(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) survivor[order[k]] = order[first[k]];
    return survivor;
}

void check_survivors(const tf::weld_result& welded, const ids& expected) {
    ids found;
    for (const std::uint32_t g : welded.groups.group_of_point)
        found.push_back(welded.groups.first_of_group[g]);
    CHECK(found == expected);
    CHECK(welded.vertex_source == welded.groups.first_of_group);
    CHECK(std::is_sorted(welded.vertex_source.begin(), welded.vertex_source.end()));
}

/// Values with many ties, some NaN, an infinity now and then.
std::vector<double> values_with_ties(test::random& source, std::size_t count) {
    std::vector<double> values(count);
    for (double& x : values) {
        x = static_cast<double>(source.below(6)) - 3.0;
        if (source.below(7) == 0) x = not_a_number;
        if (source.below(11) == 0) x = source.below(2) == 0 ? infinity : -infinity;
        if (x == 0.0 && source.below(2) == 0) x = -0.0;
    }
    return values;
}

}  // namespace

TEST_CASE("weld: an order says which point stays, ties by number and NaN last") {
    const tf::mesh cloud{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {}};
    const auto kept = [&](const std::vector<double>& q, bool highest_first, const char* by = "q") {
        return tf::weld(cloud.points, vertex_columns({{"q", q}}),
                        {.tolerance = 1.0, .order_by = by, .highest_first = highest_first})
            .vertex_source;
    };
    constexpr bool lowest = false, highest = true;
    CHECK(kept({2, 1, 3, 4}, lowest, "") == ids{0, 2});
    CHECK_THROWS_WITH_AS((void)kept({2, 1, 3, 4}, highest, ""),
                         "treeform::weld: highest_first needs order_by", std::invalid_argument);
    CHECK(kept({2, 1, 3, 4}, lowest) == ids{1, 3});
    CHECK(kept({2, 4, 3, 1}, highest) == ids{1, 3});
    CHECK(kept({5, 5, 5, 5}, lowest) == ids{0, 2});
    CHECK(kept({0.0, -0.0, 1, 1}, lowest) == ids{0, 2});
    CHECK(kept({not_a_number, infinity, not_a_number, -1}, lowest) == ids{1, 3});
    CHECK(kept({not_a_number, -infinity, not_a_number, -1}, highest) == ids{1, 3});
    const auto by_axis =
        tf::weld(cloud.points, {.tolerance = 1.0, .order_by = "x", .highest_first = true});
    CHECK(by_axis.vertex_source == ids{1, 3});
    CHECK(by_axis.groups.group_of_point == ids{0, 0, 1, 1});
    CHECK(by_axis.mesh.points == std::vector<tf::point3>{{1, 0, 0}, {3, 0, 0}});
}

TEST_CASE("weld: in any order the groups are those of the definition") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        test::random source(seed);
        const std::size_t count = 60 + source.below(200);
        tf::mesh cloud = test::lattice_soup(source, 0, count, 3 + seed % 6);
        if (seed % 3 == 0) cloud.points[source.below(count)].y = not_a_number;
        const std::vector<double> rank = values_with_ties(source, count);
        const std::vector<double> kind = values_with_ties(source, count);
        const auto properties = vertex_columns({{"rank", rank}, {"kind", kind}});
        ids label(count);
        for (auto& k : label) k = static_cast<std::uint32_t>(source.below(2)) * 7U;
        const auto odd = [](std::uint32_t i, std::uint32_t j) { return (i + j) % 5 != 3; };
        const auto same_kind = [&](std::uint32_t i, std::uint32_t j, double by) {
            return (std::isnan(kind[i]) && std::isnan(kind[j])) || kind[i] == kind[j] ||
                   std::abs(kind[i] - kind[j]) <= by;
        };
        for (const unsigned asked : {0U, 1U, 2U, 4U, 8U, 13U})
            for (const double tolerance : {0.0, 1.0, 1.5})
                for (const bool chain : {false, true})
                    for (const bool highest_first : {false, true}) {
                        CAPTURE(asked);
                        CAPTURE(tolerance);
                        tf::weld_options options{.tolerance = tolerance, .chain = chain};
                        options.order_by = "rank";
                        options.highest_first = highest_first;
                        if ((asked & 1U) != 0) options.label = label;
                        if ((asked & 2U) != 0) options.same = {{"kind"}};
                        if ((asked & 4U) != 0) options.same = {{"kind", 1.0}};
                        if ((asked & 8U) != 0) options.may_merge = odd;
                        const auto linked = [&](std::uint32_t i, std::uint32_t j) {
                            const tf::point3& p = cloud.points[i];
                            const tf::point3& q = cloud.points[j];
                            return !std::isnan(p.y) && !std::isnan(q.y) &&
                                   tf::test::brute_within(p, q, tolerance) &&
                                   ((asked & 1U) == 0 || label[i] == label[j]) &&
                                   ((asked & 2U) == 0 || same_kind(i, j, 0.0)) &&
                                   ((asked & 4U) == 0 || same_kind(i, j, 1.0)) &&
                                   ((asked & 8U) == 0 || odd(i, j));
                        };
                        const auto sorted = in_order(rank, !highest_first);
                        check_survivors(tf::weld(cloud.points, properties, options),
                                        survivors(cloud, sorted, chain, linked));
                    }
    }
}

TEST_CASE("weld: an order of whole numbers that no double holds") {
    const tf::mesh cloud{std::vector<tf::point3>(3), {}};
    constexpr std::int64_t large = std::int64_t{1} << 60;
    const std::vector<std::int64_t> time{large + 1, large, -large};
    const std::vector<std::uint64_t> id{~std::uint64_t{0} - 1, ~std::uint64_t{0}, 0};
    tf::attributes properties;
    properties.find_or_add("vertex", 3).columns = {tf::column::of<std::int64_t>("time", time),
                                                   tf::column::of<std::uint64_t>("id", id)};
    const auto kept = [&](const char* by, bool highest_first) {
        return tf::weld(cloud.points, properties, {.order_by = by, .highest_first = highest_first})
            .vertex_source;
    };
    CHECK(kept("time", false) == ids{2});
    CHECK(kept("time", true) == ids{0});
    CHECK(kept("id", false) == ids{2});
    CHECK(kept("id", true) == ids{1});
}

TEST_CASE("weld: faces follow points that are kept by an order, split groups keep theirs") {
    // A square cut along its diagonal: each end has two copies, the second of lower rank.
    tf::mesh_file file;
    file.mesh = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                 {{0, 1, 2}, {3, 4, 5}}};
    file.attributes = vertex_columns({{"rank", {5, 5, 5, 1, 2, 9}}});
    for (const bool manifold : {false, true}) {
        tf::weld_options options{.keep_manifold = manifold};
        options.order_by = "rank";
        const auto welded = tf::weld(file, options);
        CHECK(welded.vertex_source == ids{1, 3, 4, 5});
        CHECK(welded.groups.group_of_point == ids{1, 0, 2, 1, 2, 3});
        CHECK(welded.file.mesh.faces == std::vector<tf::face>{{1, 0, 2}, {1, 2, 3}});
    }
}

TEST_CASE("count_mergeable: looks in the order that it was welded in") {
    const double step = std::numeric_limits<float>::epsilon();
    // Once rounded, the middle one is within the tolerance of both others.
    tf::mesh_file file;
    const double reach = 1.0;
    file.mesh.points = {{0, 0, 0}, {1.0 + step / 4, 0, 0}, {2.0 + step, 0, 0}};
    file.attributes = vertex_columns({{"rank", {2, 1, 3}}});
    tf::weld_options options{.tolerance = reach};
    CHECK(tf::count_mergeable(file, options, tf::precision::float32) == 1);
    options.order_by = "rank";
    CHECK(tf::count_mergeable(file, options, tf::precision::float64) == 0);
    CHECK(tf::count_mergeable(file, options, tf::precision::float32) == 2);
}

TEST_CASE("weld: orders that cannot be meant are refused") {
    const tf::mesh cloud{{{0, 0, 0}}, {}};
    const auto refused = [&](const tf::attributes& properties, const std::string& by,
                             const std::string& reason) {
        try {
            static_cast<void>(tf::weld(cloud.points, properties, {.order_by = by}));
            FAIL("not refused");
        } catch (const tf::weld_property_error& error) {
            CHECK(error.option() == "order_by");
            CHECK(error.reason() == reason);
        }
    };
    refused({}, "q", "");
    refused(vertex_columns({{"nx", {0}}, {"ny", {0}}}), "normal", "is more than one property");
    CHECK_THROWS_AS(
        static_cast<void>(tf::weld(cloud.points, {.keep = tf::weld_keep::mean, .order_by = "x"})),
        std::invalid_argument);
}
