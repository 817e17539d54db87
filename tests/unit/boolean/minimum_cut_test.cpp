/// \file
/// Least cuts against all cuts there are.

#include <libmesh/boolean/minimum_cut.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace {

using tf::detail::boolean::minimum_cut;
using tf::detail::boolean::network;

constexpr auto never_stop = [] { return false; };

std::int64_t capacity_of(const network& given, const std::vector<std::uint8_t>& side) {
    std::int64_t sum = 0;
    for (std::size_t v = 0; v < side.size(); ++v)
        sum += side[v] != 0 ? given.to_sink[v] : given.from_source[v];
    for (const auto& e : given.edges)
        if (side[e.from] != 0 && side[e.to] == 0) sum += e.capacity;
    return sum;
}

/// Of all least ones, what they have in common on the source's side.
std::vector<std::uint8_t> smallest_least_cut(const network& given) {
    const std::size_t n = given.from_source.size();
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::vector<std::uint8_t> common;
    for (std::size_t bits = 0; bits < std::size_t{1} << n; ++bits) {
        std::vector<std::uint8_t> side(n);
        for (std::size_t v = 0; v < n; ++v) side[v] = (bits >> v) & 1U;
        const std::int64_t here = capacity_of(given, side);
        if (here > least) continue;
        if (here < least) common = side;
        for (std::size_t v = 0; v < n; ++v) common[v] &= side[v];
        least = here;
    }
    return common;
}

}  // namespace

TEST_CASE("minimum cut: no node, one node, and two that hold together") {
    CHECK(minimum_cut({}, never_stop)->empty());
    CHECK(*minimum_cut({{2}, {3}, {}}, never_stop) == std::vector<std::uint8_t>{0});
    CHECK(*minimum_cut({{3}, {2}, {}}, never_stop) == std::vector<std::uint8_t>{1});
    CHECK(*minimum_cut({{3}, {3}, {}}, never_stop) == std::vector<std::uint8_t>{0});  // the fewest
    CHECK(*minimum_cut({{9, 0}, {0, 2}, {{0, 1, 5}}}, never_stop) ==
          std::vector<std::uint8_t>{1, 1});
    CHECK(*minimum_cut({{9, 0}, {0, 5}, {{0, 1, 2}}}, never_stop) ==
          std::vector<std::uint8_t>{1, 0});
    CHECK(*minimum_cut({{9, 0}, {0, 5}, {{1, 0, 7}}}, never_stop) ==
          std::vector<std::uint8_t>{1, 0});
}

TEST_CASE("minimum cut: on random networks, the smallest of the least of all cuts") {
    test::random source(5);
    for (int round = 0; round < 300; ++round) {
        network given;
        const std::size_t n = 1 + source.below(9);
        for (std::size_t v = 0; v < n; ++v) {
            given.from_source.push_back(static_cast<std::int64_t>(source.below(6)));
            given.to_sink.push_back(static_cast<std::int64_t>(source.below(6)));
        }
        for (std::size_t e = source.below(4 * n); e-- > 0;)
            given.edges.push_back({static_cast<std::uint32_t>(source.below(n)),
                                   static_cast<std::uint32_t>(source.below(n)),
                                   static_cast<std::int64_t>(source.below(5))});
        CAPTURE(round);
        REQUIRE(*minimum_cut(given, never_stop) == smallest_least_cut(given));
    }
}

TEST_CASE("minimum cut: a long chain, and a stop") {
    network given;
    constexpr std::uint32_t n = 100000;
    given.from_source.assign(n, 0);
    given.to_sink.assign(n, 0);
    given.from_source[0] = given.to_sink[n - 1] = std::int64_t{1} << 50;
    for (std::uint32_t v = 0; v + 1 < n; ++v)
        given.edges.push_back({v, v + 1, v == 777 ? 3 : std::int64_t{1} << 40});
    const auto side = minimum_cut(given, never_stop);
    REQUIRE(side);
    CHECK((*side)[777] == 1);
    CHECK((*side)[778] == 0);
    CHECK_FALSE(minimum_cut(given, [] { return true; }));
}
