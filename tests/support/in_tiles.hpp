#pragma once
/// \file
/// Clouds welded in tiles, with what lies along the borders settled in any way that may be chosen.

#include <libmesh/weld/crowded_chain.hpp>
#include <libmesh/weld/first_pass.hpp>
#include <libmesh/weld/near_cells.hpp>
#include <libmesh/weld/tile_cuts.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <span>
#include <vector>

namespace test {

using tf::point3;
constexpr bool by_first = false, by_chain = true;  // `weld_options::chain`
using tf::detail::weld::asked_point;
using tf::detail::weld::border_point;
using tf::detail::weld::border_weld;
using tf::detail::weld::longest_move;
using tf::detail::weld::near_places;
using tf::detail::weld::number_slices;
using tf::detail::weld::reach_of_open;
using tf::detail::weld::tile_cuts;
using tf::detail::weld::tile_drop;
using tf::detail::weld::tile_member;
using tf::detail::weld::tile_point;
using tf::detail::weld::tile_result;
using tf::detail::weld::tile_role;
using cloud = std::vector<point3>;

inline bool is_finite(const point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

struct tiled {
    std::vector<std::uint64_t> leader;
    double longest = 0.0;
    std::size_t border = 0;
    std::size_t handed_over = 0;  ///< from runs to bundles
    std::size_t received = 0;     ///< by runs, each point once
};

inline std::vector<std::vector<tile_point>> scatter(const cloud& points, const tile_cuts& cuts) {
    std::vector<std::vector<tile_point>> tiles(cuts.size());
    std::vector<std::uint32_t> halos;
    bool in_range = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_finite(points[i])) continue;
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

inline tile_result weld_tile(const std::vector<tile_point>& points, bool chain, double tolerance,
                             test::random& random, const values_of_points& more = {},
                             const number_slices& slices = {}) {
    tf::detail::weld::tile_weld tile(chain, tolerance, more.agree, slices);
    tile_result result;
    in_blocks(points, random, [&](auto block) { tile.add(block, result, more.of(block)); });
    while (tile.finish(result)) {
    }
    return result;
}

inline tile_result weld_crowded(const std::vector<tile_point>& points, double tolerance,
                                test::random& random) {
    tf::detail::weld::crowded_chain tile(tolerance);
    tile_result result;
    in_blocks(points, random, [&](auto block) { tile.find_cubes(block); });
    in_blocks(points, random, [&](auto block) { tile.link_cubes(block); });
    in_blocks(points, random, [&](auto block) { tile.append_result(block, result); });
    return result;
}

inline void check_equal(const tile_result& a, const tile_result& b) {
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

/// What tiles leave to a border pass, or such a pass to the next one.
struct left_to_borders {
    struct asked {
        asked_point point;
        std::vector<std::uint64_t> values;
    };
    std::vector<border_point> points{};
    std::vector<asked> asks{};

    void add(const left_to_borders& other) {
        points.insert(points.end(), other.points.begin(), other.points.end());
        asks.insert(asks.end(), other.asks.begin(), other.asks.end());
    }
    void add(const tile_result& of, std::size_t width) {
        points.insert(points.end(), of.border.begin(), of.border.end());
        for (std::size_t i = 0; i < of.asked.size(); ++i) {
            const auto values = std::span(of.asked_values).subspan(i * width, width);
            asks.push_back({of.asked[i], {values.begin(), values.end()}});
        }
    }
};

/// What tiles [first, last) leave to others: by one pass, or by one over what two passes leave,
/// each over a half of them, and so on; each of them a run of slices of the numbers at a time.
struct passes {
    bool chain;
    double tolerance;
    const tile_cuts& cuts;
    const std::vector<tile_result>& tiles;
    const values_of_points& more;
    number_slices slices;
    std::uint64_t slices_a_run;
    bool by_halves;
    std::uint64_t count;  ///< points
    std::vector<tile_drop> dropped{};
    longest_move longest{};
    border_weld joined{0.0};  ///< by all passes
    std::size_t handed_over = 0;
    std::size_t received = 0;

    left_to_borders over(std::size_t first, std::size_t last) {
        left_to_borders from;
        if (by_halves && last - first > 1) {
            const std::size_t middle = (first + last) / 2;
            from = over(first, middle);
            from.add(over(middle, last));
        } else {
            for (std::size_t t = first; t < last; ++t) from.add(tiles[t], more.agree.size());
        }
        std::ranges::stable_sort(from.points, {}, &border_point::id);
        tile_result out;
        left_to_borders left;
        std::array<std::vector<border_point>, number_slices::bundles> inbox;
        auto next = from.points.begin();
        for (std::uint64_t slice = 0; slices.slice_begin(slice) < count; slice += slices_a_run) {
            const run mine{slices.slice_begin(slice),
                           std::min(count, slices.slice_begin(slice + slices_a_run))};
            const auto begin = next;
            while (next != from.points.end() && next->id() < mine.end) ++next;
            border_weld pass(tolerance, more.agree, slices);
            receive(pass, mine, {begin, next}, inbox);
            for (const border_point& p : std::span(begin, next))
                pass.add(p, values_of(p.id()), is_outer(p.at, first, last), out);
            for (const left_to_borders::asked& a : from.asks) {
                if (!mine.meets(a.point.bundle, slices)) continue;
                hand_over(pass, a, mine, inbox);
                const bool is_first = slices.bundle_begin(a.point.bundle) >= mine.begin;
                if (is_first && is_outer(a.point.at, first, last)) left.asks.push_back(a);
            }
            while (pass.finish(out)) {
            }
            join(pass, {begin, next}, first, last, out);
        }
        left.add(out, more.agree.size());
        dropped.insert(dropped.end(), out.dropped.begin(), out.dropped.end());
        longest.consider(out.move);
        return left;
    }

  private:
    [[nodiscard]] std::span<const std::uint64_t> values_of(std::uint64_t id) const {
        return {more.at(id), more.agree.size()};
    }
    [[nodiscard]] bool is_outer(const point3& p, std::size_t first, std::size_t last) const {
        std::vector<std::uint32_t> halos;
        const auto is_other = [&](std::uint32_t t) { return t < first || t >= last; };
        return is_other(cuts.find(p, halos)) || std::ranges::any_of(halos, is_other);
    }
    struct run {
        std::uint64_t begin;
        std::uint64_t end;

        [[nodiscard]] bool meets(std::uint64_t bundle, const number_slices& of) const {
            return of.bundle_of(begin) <= bundle && bundle <= of.bundle_of(end - 1);
        }
    };
    using inboxes = std::array<std::vector<border_point>, number_slices::bundles>;

    /// Of each bundle that the run has some of, what may be near the run's own, once.
    void receive(border_weld& pass, const run& mine, std::span<const border_point> own,
                 const inboxes& inbox) {
        near_places places(reach_of_open(tolerance), own.size());
        for (const border_point& p : own) places.add(p.at);
        std::map<std::uint64_t, border_point> all;
        for (std::size_t bundle = 0; bundle < inbox.size(); ++bundle) {
            if (!mine.meets(bundle, slices)) continue;
            for (const border_point& p : inbox[bundle]) {
                if (!places.may_have(p.at)) continue;
                const auto [same, is_new] = all.emplace(p.tag, p);
                if (!is_new) same->second.leader |= p.leader;
            }
        }
        for (const auto& [tag, p] : all) pass.receive(p, values_of(p.id()));
        received += all.size();
    }
    /// Each once to a bundle.
    void hand_over(border_weld& pass, const left_to_borders::asked& asked, const run& mine,
                   inboxes& inbox) {
        std::vector<border_point> found;
        pass.hand_over(asked.point, asked.values, found);
        const std::uint64_t later = slices.from(mine.end, asked.point.asked_by);
        for (std::size_t bundle = 0; bundle < inbox.size(); ++bundle) {
            if (!number_slices::has(later, bundle)) continue;
            handed_over += found.size();
            for (const border_point& p : found) {
                const auto same = std::ranges::find(inbox[bundle], p.tag, &border_point::tag);
                if (same != inbox[bundle].end())
                    same->leader |= p.leader;
                else
                    inbox[bundle].push_back(p);
            }
        }
    }
    void join(border_weld& pass, std::span<const border_point> border, std::size_t first,
              std::size_t last, tile_result& out) {
        for (const border_point& link : pass.joined()) {
            out.dropped.push_back({link.id(), link.leader});
            joined.join(link);
        }
        if (!chain) return;
        for (const border_point& p : border)
            if (is_outer(p.at, first, last)) out.border.push_back(pass.handed_on(p));
    }
};

/// How the border is settled.
struct border_way {
    bool by_halves = false;
    std::uint64_t slices_a_run = 0;  ///< 0: one run of all
    unsigned least_bits = number_slices::bits_of_slice;
};
inline constexpr std::array<border_way, 6> border_ways{
    {{false, 0}, {false, 1}, {false, 7, 0}, {true, 0}, {true, 1}, {true, 3, 0}}};

/// The leader of each point by `count` tiles, done in an order of `random`, in blocks of any size.
inline tiled weld_in_tiles(const cloud& points, bool chain, double tolerance, std::size_t count,
                           test::random& random, const values_of_points& more = {},
                           const border_way& way = {}) {
    cloud sample;
    std::copy_if(points.begin(), points.end(), std::back_inserter(sample), is_finite);
    const tile_cuts planned(sample, tolerance, count);
    const tile_cuts slabs({planned.nodes().begin(), planned.nodes().end()}, tolerance);
    const auto tiles = scatter(points, slabs);
    const bool in_runs = way.slices_a_run > 0 && !chain;
    const number_slices slices =
        in_runs ? number_slices(points.size(), way.least_bits) : number_slices();
    std::vector<std::size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    random.shuffle(order);

    tiled all;
    all.leader.resize(points.size());
    std::iota(all.leader.begin(), all.leader.end(), std::uint64_t{0});
    longest_move longest;
    std::vector<tile_drop> dropped;
    std::vector<tile_member> members;
    std::vector<tile_result> results(tiles.size());
    for (const std::size_t t : order) {
        const tile_result& result = results[t] =
            weld_tile(tiles[t], chain, tolerance, random, more, slices);
        if (!chain)
            REQUIRE(result.border_values.size() == result.border.size() * more.agree.size());
        REQUIRE(result.asked_values.size() == result.asked.size() * more.agree.size());
        if (chain && tiles.size() <= 3 && more.agree.size() == 0)
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

    passes pass{
        chain,         tolerance,    slabs, results, more, slices, in_runs ? way.slices_a_run : 1,
        way.by_halves, points.size()};
    const left_to_borders left = pass.over(0, tiles.size());
    REQUIRE(left.points.empty());
    REQUIRE(left.asks.empty());
    all.handed_over = pass.handed_over;
    all.received = pass.received;
    longest.consider(pass.longest);
    for (const tile_member& m : members) pass.joined.measure(m, longest);
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

}  // namespace test
