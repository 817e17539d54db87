#include <libmesh/base/union_find.hpp>
#include <libmesh/weld/crowded_chain.hpp>
#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/tile_weld.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace treeform::detail::weld {
namespace {

constexpr std::uint32_t no_crowd = std::numeric_limits<std::uint32_t>::max();

/// Points of one cube that are within the tolerance of its first. Where rounding makes cubes wider,
/// there may be several in one.
struct crowd {
    point3 first;
    point3 low;
    point3 high;
    std::uint64_t id;  ///< of the first
    bool elsewhere;

    void take(const tile_point& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p.at[axis]);
            high[axis] = std::max(high[axis], p.at[axis]);
        }
        elsewhere = elsewhere || p.role() != tile_role::own;
    }
};

using cube = std::array<std::int64_t, 3>;

std::uint64_t cube_hash_of(const cube& c) { return cube_hash(c[0], c[1], c[2], 0); }

cube bits_of(const point3& p) {
    return {std::bit_cast<std::int64_t>(p.x + 0.0), std::bit_cast<std::int64_t>(p.y + 0.0),
            std::bit_cast<std::int64_t>(p.z + 0.0)};
}

}  // namespace

struct crowded_chain::state {
    explicit state(double tolerance)
        : within(tolerance), axis(tolerance > 0.0 ? tolerance / cubes_per_tolerance : 1.0) {}

    [[nodiscard]] cube cube_of(const point3& p) const {
        if (within.distance() == 0.0) return bits_of(p);
        return {axis.index(p.x), axis.index(p.y), axis.index(p.z)};
    }

    /// The crowd of `p`, the lowest where it might be in several; `no_crowd` when it is in none.
    [[nodiscard]] std::uint32_t find(const point3& p, const cube& at) const {
        std::uint32_t lowest = no_crowd;
        by_cube.visit(cube_hash_of(at), [&](std::uint32_t c) {
            if (c < lowest && cube_of(crowds[c].first) == at && within.holds(p, crowds[c].first))
                lowest = c;
        });
        return lowest;
    }

    void find_cubes(const tile_point& p) {
        const cube at = cube_of(p.at);
        std::uint32_t c = find(p.at, at);
        if (c == no_crowd) {
            if (crowds.size() == no_crowd - 1)
                throw std::invalid_argument("treeform::crowded_chain: too many cubes");
            c = static_cast<std::uint32_t>(crowds.size());
            crowds.push_back({p.at, p.at, p.at, p.id(), false});
            by_cube.add(cube_hash_of(at), c);
        }
        crowds[c].take(p);
    }

    /// Calls `meet(c)` for the crowds that may have points within the tolerance of some of `b`.
    template <class Meet>
    void visit_around(std::uint32_t b, const Meet& meet) const {
        std::array<cube_axis::range, 3> ranges;
        for (std::size_t k = 0; k < 3; ++k) ranges[k] = axis.neighbors(crowds[b].first[k], 2);
        for (std::int64_t x = ranges[0].first; x <= ranges[0].last; ++x)
            for (std::int64_t y = ranges[1].first; y <= ranges[1].last; ++y)
                for (std::int64_t z = ranges[2].first; z <= ranges[2].last; ++z)
                    by_cube.visit(cube_hash_of({x, y, z}), [&](std::uint32_t c) {
                        if (c != b) meet(c);
                    });
    }

    /// Whether the boxes around the points of two crowds are within the tolerance.
    [[nodiscard]] bool boxes_meet(const crowd& a, const crowd& b) const {
        point3 on_a;
        point3 on_b;
        for (std::size_t k = 0; k < 3; ++k) {
            on_a[k] = std::clamp(b.low[k], a.low[k], a.high[k]);
            on_b[k] = std::clamp(on_a[k], b.low[k], b.high[k]);
        }
        return within.holds(on_a, on_b);
    }
    [[nodiscard]] bool box_is_near(const point3& p, const crowd& c) const {
        point3 nearest;
        for (std::size_t k = 0; k < 3; ++k) nearest[k] = std::clamp(p[k], c.low[k], c.high[k]);
        return within.holds(p, nearest);
    }

    /// With tolerance 0 crowds have nothing to do with each other.
    void join_firsts() {
        sets.emplace(crowds.size());
        open_of.assign(crowds.size() + 1, 0);
        if (within.distance() == 0.0) return;
        const auto count = static_cast<std::uint32_t>(crowds.size());
        for (std::uint32_t b = 0; b < count; ++b)
            visit_around(b, [&](std::uint32_t c) {
                if (c < b && sets->root(b) != sets->root(c) &&
                    within.holds(crowds[b].first, crowds[c].first))
                    sets->join(b, c);
            });
        for (std::uint32_t b = 0; b < count; ++b) {
            visit_around(b, [&](std::uint32_t c) {
                if (sets->root(b) != sets->root(c) && boxes_meet(crowds[b], crowds[c]))
                    open.push_back(c);
            });
            open_of[b + 1] = open.size();
        }
    }

    void link_cubes(const tile_point& p) {
        const std::uint32_t b = find(p.at, cube_of(p.at));
        bool matters = false;
        for (std::size_t k = open_of[b]; k < open_of[b + 1]; ++k) {
            const std::uint32_t c = open[k];
            if (sets->root(b) == sets->root(c) || !box_is_near(p.at, crowds[c])) continue;
            if (within.holds(p.at, crowds[c].first))
                sets->join(b, c);
            else
                matters = true;
        }
        if (matters) keep(p.at, b);
    }

    void keep(const point3& p, std::uint32_t b) {
        const std::uint64_t hash = cube_hash_of(bits_of(p));
        bool known = false;
        kept_by_place.visit(hash, [&](std::uint32_t i) { known = known || kept[i] == p; });
        if (known) return;
        kept_by_place.add(hash, static_cast<std::uint32_t>(kept.size()));
        kept.push_back(p);
        crowd_of_kept.push_back(b);
    }

    void join_kept() {
        const point_groups groups =
            group_points(kept, {.tolerance = within.distance(), .chain = true});
        for (std::size_t i = 0; i < kept.size(); ++i)
            sets->join(crowd_of_kept[i],
                       crowd_of_kept[groups.first_of_group[groups.group_of_point[i]]]);
        kept = {};
        crowd_of_kept = {};
        kept_by_place = {};
        for (std::uint32_t b = 0; b < crowds.size(); ++b)
            if (crowds[b].elsewhere) crowds[sets->root(b)].elsewhere = true;
    }

    /// Crowds come by ascending numbers of their firsts, so the lowest of a set has the lowest.
    void append_result(const tile_point& p, tile_result& out) {
        const crowd& lowest = crowds[sets->root(find(p.at, cube_of(p.at)))];
        append_chain_point(p, {lowest.id, lowest.first, lowest.elsewhere}, out);
    }

    reach within;
    cube_axis axis;
    std::vector<crowd> crowds{};
    hashed_ids by_cube{};
    std::optional<detail::base::union_find> sets{};
    std::vector<std::size_t> open_of{};  ///< crowds near crowd b: `open` from open_of[b] on
    std::vector<std::uint32_t> open{};
    std::vector<point3> kept{};
    std::vector<std::uint32_t> crowd_of_kept{};
    hashed_ids kept_by_place{};
    bool joined = false;  ///< `kept` has been
};

crowded_chain::crowded_chain(double tolerance) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
        throw std::invalid_argument(
            "treeform::crowded_chain: the tolerance must be finite and not negative");
    state_ = std::make_unique<state>(tolerance);
}
crowded_chain::~crowded_chain() = default;
crowded_chain::crowded_chain(crowded_chain&&) noexcept = default;
crowded_chain& crowded_chain::operator=(crowded_chain&&) noexcept = default;

void crowded_chain::find_cubes(std::span<const tile_point> points) {
    for (const tile_point& p : points) state_->find_cubes(p);
}

void crowded_chain::link_cubes(std::span<const tile_point> points) {
    if (!state_->sets) state_->join_firsts();
    for (const tile_point& p : points) state_->link_cubes(p);
}

void crowded_chain::append_result(std::span<const tile_point> points, tile_result& out) {
    if (!state_->joined) {
        state_->join_kept();
        state_->joined = true;
    }
    for (const tile_point& p : points) state_->append_result(p, out);
}

}  // namespace treeform::detail::weld
