#include <libmesh/weld/moves.hpp>
#include <libmesh/weld/near_cells.hpp>
#include <libmesh/weld/nearest_kept.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/settle_in_chain.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <libmesh/weld/tolerance.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace treeform::detail::weld {
namespace {

struct kept_point {
    point3 at{};
    std::uint64_t id = 0;
};

/// An open point. One that `stands` does so for all open points within a fourth of the tolerance.
struct open_point {
    point3 at{};
    std::uint64_t tag = 0;

    [[nodiscard]] static open_point make(std::uint64_t id, const point3& at) {
        return {at, id << 1};
    }
    [[nodiscard]] std::uint64_t id() const { return tag >> 1; }
    [[nodiscard]] bool stands() const { return (tag & 1) != 0; }
    void stand() { tag |= 1; }
};

/// What a pass remembers of points with their values.
template <class Point>
struct remembered {
    near_cells<Point> cells;
    std::vector<std::uint64_t> values{};  ///< in the order of the numbers in `cells`

    void add(const Point& point, std::span<const std::uint64_t> its_values, std::uint64_t salt) {
        cells.add(point, salt);
        values.insert(values.end(), its_values.begin(), its_values.end());
    }
};

/// The rule first, of the points of a tile or of the borders of some.
class first_pass {
  public:
    first_pass(double tolerance, const agreement& agree)
        : agree_(agree),
          within_(tolerance),
          // Where 1.26 tolerances leave the doubles, open points stand for equal ones only.
          within_fourth_(tolerance < largest ? 0.25 * tolerance : 0.0),
          within_more_(tolerance < largest ? 1.26 * tolerance : tolerance),
          kept_{near_cells<kept_point>(within_.distance(), agree.size() > 0)},
          open_{near_cells<open_point>(within_more_.distance(), agree.size() > 0)} {}

    void reserve(std::size_t points) {
        kept_.cells.reserve(points);
        kept_.values.reserve(points * agree_.size());
    }

    void add(std::span<const tile_point> points, std::span<const std::uint64_t> values,
             tile_result& out) {
        constexpr std::size_t ahead = 12;
        const auto salt = [&](std::size_t i) {
            return agree_.salt(values.data() + i * agree_.size());
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i + 2 * ahead < points.size())
                kept_.cells.prefetch(points[i + 2 * ahead].at, salt(i + 2 * ahead));
            if (i + ahead < points.size())
                kept_.cells.prefetch_entry(points[i + ahead].at, salt(i + ahead));
            const tile_point& p = points[i];
            add({.id = p.id(),
                 .at = p.at,
                 .values = values.data() + i * agree_.size(),
                 .salt = salt(i),
                 .own = p.role() != tile_role::halo,
                 .shared = p.role() == tile_role::shared},
                out);
        }
    }

    void add(const border_point& p, std::span<const std::uint64_t> values, bool outer,
             tile_result& out) {
        const arrival a{.id = p.id(),
                        .at = p.at,
                        .values = values.data(),
                        .salt = agree_.salt(values.data()),
                        .shared = outer,
                        .unsure = outer,
                        .leaning = p.kind() == border_kind::leaning ? &p : nullptr};
        if (p.kind() == border_kind::kept)
            keep(a, out);
        else
            add(a, out);
    }

  private:
    static constexpr double largest = 0x1p1000;

    struct arrival {
        std::uint64_t id;
        const point3& at;
        const std::uint64_t* values;
        std::uint64_t salt;
        bool own = true;
        bool shared = false;  ///< others have to know of it
        bool unsure = false;  ///< some of its neighbors may be unknown here
        const border_point* leaning = nullptr;
    };

    void add(const arrival& a, tile_result& out) {
        const neighbors around = look(a);
        if (around.kept.any()) {
            if (a.own) drop(a, around, out);
        } else if (!a.own || a.unsure || around.some_open) {
            if (a.own) put(at(a, border_kind::open), a, out);
            if (around.covering != nullptr)
                around.covering->stand();
            else
                open_.add(open_point::make(a.id, a.at), values_of(a), a.salt);
        } else {
            keep(a, out);
        }
    }

    void keep(const arrival& a, tile_result& out) {
        if (a.shared) put(at(a, border_kind::kept), a, out);
        kept_.add({.at = a.at, .id = a.id}, values_of(a), a.salt);
    }

    [[nodiscard]] std::span<const std::uint64_t> values_of(const arrival& a) const {
        return {a.values, agree_.size()};
    }
    void put(const border_point& b, const arrival& a, tile_result& out) const {
        out.border.push_back(b);
        out.border_values.insert(out.border_values.end(), a.values, a.values + agree_.size());
    }

    struct neighbors {
        nearest_kept kept;
        nearest_kept open;       ///< of those that stand for themselves
        double standing_square;  ///< of the distance of the nearest other one, rounded; or infinity
        bool some_open;
        open_point* covering;
    };

    neighbors look(const arrival& a) {
        const point3& p = a.at;
        neighbors found{nearest_kept(p), nearest_kept(p), infinity, false, nullptr};
        if (a.leaning != nullptr) found.kept.consider(a.leaning->leader, a.leaning->leader_at);
        const auto agrees = [&](const std::vector<std::uint64_t>& values, std::size_t number) {
            return agree_.holds(a.values, values.data() + number * agree_.size());
        };
        kept_.cells.visit(p, a.salt, [&](const kept_point& q, std::size_t number) {
            if (within_.holds(p, q.at) && agrees(kept_.values, number))
                found.kept.consider(q.id, q.at);
        });
        open_.cells.visit(p, a.salt, [&](open_point& q, std::size_t number) {
            if (!(q.stands() ? within_more_ : within_).holds(p, q.at)) return;
            if (!agrees(open_.values, number)) return;
            found.some_open = true;
            if (q.stands())
                found.standing_square = std::min(
                    {found.standing_square, rounded_squared_distance(p, q.at), largest_square});
            else
                found.open.consider(q.id(), q.at);
            if (within_fourth_.holds(p, q.at) &&
                agree_.same(a.values, open_.values.data() + number * agree_.size()))
                found.covering = &q;
        });
        return found;
    }

    void drop(const arrival& a, const neighbors& around, tile_result& out) const {
        const nearest_kept& kept = around.kept;
        if (!a.unsure && !open_may_precede(a.at, around)) {
            out.dropped.push_back({a.id, kept.id()});
            out.move.consider(a.at, kept.at());
            return;
        }
        border_point leaning = at(a, border_kind::leaning);
        leaning.leader = kept.id();
        leaning.leader_at = kept.at();
        put(leaning, a, out);
    }

    /// What stands for others is nearer by a fourth of the tolerance, as far as is known.
    [[nodiscard]] bool open_may_precede(const point3& p, const neighbors& around) const {
        if (!around.some_open) return false;
        if (around.open.any() && around.kept.precedes(around.open.id(), around.open.at()))
            return true;
        if (!(around.standing_square < infinity)) return around.standing_square != infinity;
        const double kept = rounded_squared_distance(p, around.kept.at());
        const double least = around.standing_square;
        // The roots of sums in this range are off by less than a part in 2^48.
        if (!(least > 0x1p-900 && kept > 0x1p-900 && kept < 0x1p1000)) return true;
        return std::sqrt(least) - within_fourth_.distance() * (1.0 + 0x1p-40) <=
               std::sqrt(kept) * (1.0 + 0x1p-40);
    }

    [[nodiscard]] static border_point at(const arrival& a, border_kind kind) {
        border_point b = border_point::make(a.id, kind);
        b.at = a.at;
        return b;
    }

    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double largest_square = std::numeric_limits<double>::max();

    const agreement& agree_;
    reach within_;
    reach within_fourth_;
    reach within_more_;
    remembered<kept_point> kept_;
    remembered<open_point> open_;
};

/// The rule chain inside a tile.
class chain_in_tile {
  public:
    chain_in_tile(double tolerance, const agreement& agree)
        : agree_(agree), tolerance_(tolerance) {}

    void reserve(std::size_t points) {
        points_.reserve(points);
        tags_.reserve(points);
        values_.reserve(points * agree_.size());
    }

    void add(std::span<const tile_point> points, std::span<const std::uint64_t> values) {
        values_.insert(values_.end(), values.begin(), values.end());
        for (const tile_point& p : points) {
            points_.push_back(p.at);
            tags_.push_back(p.tag);
        }
    }

    /// Returns whether there is more.
    [[nodiscard]] bool finish(tile_result& out) {
        constexpr std::size_t piece = std::size_t{1} << 16;
        if (next_ == 0) group();
        const std::size_t end = std::min(tags_.size(), next_ + piece);
        for (; next_ < end; ++next_) {
            const std::uint32_t group = groups_.group_of_point[next_];
            const std::uint32_t lowest = groups_.first_of_group[group];
            settle_in_chain({tags_[next_], points_[next_]},
                            {tags_[lowest] >> 2, points_[lowest], elsewhere_[group]}, out);
        }
        return next_ < tags_.size();
    }

  private:
    void group() {
        weld_options options{.tolerance = tolerance_, .rule = weld_rule::chain};
        const std::vector<std::uint32_t> labels = agree_.labels(values_);
        options.label = labels;
        if (!agree_.is_transitive())
            options.may_merge = [&](std::uint32_t i, std::uint32_t j) {
                return agree_.holds(values_.data() + i * agree_.size(),
                                    values_.data() + j * agree_.size());
            };
        groups_ = group_points(points_, options);
        elsewhere_.assign(groups_.first_of_group.size(), false);
        for (std::size_t i = 0; i < tags_.size(); ++i)
            if (tile_point{tags_[i], {}}.role() != tile_role::own)
                elsewhere_[groups_.group_of_point[i]] = true;
    }

    const agreement& agree_;
    double tolerance_;
    std::vector<point3> points_{};
    std::vector<std::uint64_t> tags_{};
    std::vector<std::uint64_t> values_{};
    point_groups groups_{};
    std::vector<bool> elsewhere_{};  ///< [G] some of the group's points are in other tiles, too
    std::size_t next_ = 0;
};

/// Sets of numbers; each is known by its lowest, and where that is.
class lowest_points {
  public:
    struct place {
        std::uint64_t id = 0;
        point3 at{};
    };

    void join(const place& a, const place& b) {
        const place x = shorten(a);
        const place y = shorten(b);
        if (x.id != y.id) above_[std::max(x.id, y.id)] = x.id < y.id ? x : y;
    }
    [[nodiscard]] place lowest(place a) const {
        for (auto up = above_.find(a.id); up != above_.end(); up = above_.find(a.id))
            a = up->second;
        return a;
    }
    /// All that are not lowest, ascending, each with its lowest.
    [[nodiscard]] std::vector<border_point> flatten() {
        std::vector<std::uint64_t> all;
        all.reserve(above_.size());
        for (const auto& up : above_) all.push_back(up.first);
        std::sort(all.begin(), all.end());
        std::vector<border_point> links;
        links.reserve(all.size());
        for (const std::uint64_t id : all) {
            const place top = shorten({id, {}});
            links.push_back(border_point::make(id, border_kind::link));
            links.back().leader = top.id;
            links.back().leader_at = top.at;
        }
        return links;
    }

  private:
    /// As `lowest`, and hangs what is on the way directly below it.
    place shorten(place a) {
        const place top = lowest(a);
        for (auto up = above_.find(a.id); up != above_.end(); up = above_.find(a.id)) {
            a = up->second;
            up->second = top;
            if (a.id == top.id) break;
        }
        return top;
    }

    std::unordered_map<std::uint64_t, place> above_{};
};

}  // namespace

void longest_move::consider(const point3& from, const point3& to) {
    if (from == to) return;
    const order known =
        compare_rounded(rounded_squared_distance(from, to), rounded_squared_distance(from_, to_));
    if (known == order::less) return;
    if (known == order::unsure && compare_distance(from, to, from_, to_) <= 0) return;
    from_ = from;
    to_ = to;
}

double longest_move::length() const {
    const std::array<std::uint32_t, 1> only{0};
    return max_displacement({&from_, 1}, only, {&to_, 1});
}

struct tile_weld::state {
    agreement agree{};
    std::optional<first_pass> first{};
    std::optional<chain_in_tile> chain{};
};

tile_weld::tile_weld(weld_rule rule, double tolerance, agreement agree)
    : state_(std::make_unique<state>()) {
    check_tolerance("tile_weld", tolerance);
    state_->agree = std::move(agree);
    if (rule == weld_rule::first)
        state_->first.emplace(tolerance, state_->agree);
    else
        state_->chain.emplace(tolerance, state_->agree);
}
tile_weld::~tile_weld() = default;
tile_weld::tile_weld(tile_weld&&) noexcept = default;
tile_weld& tile_weld::operator=(tile_weld&&) noexcept = default;

void tile_weld::reserve(std::size_t points) {
    if (state_->first) state_->first->reserve(points);
    if (state_->chain) state_->chain->reserve(points);
}

void tile_weld::add(std::span<const tile_point> points, tile_result& out,
                    std::span<const std::uint64_t> values) {
    assert(values.size() == points.size() * state_->agree.size());
    if (state_->first) state_->first->add(points, values, out);
    if (state_->chain) state_->chain->add(points, values);
}

bool tile_weld::finish(tile_result& out) { return state_->chain && state_->chain->finish(out); }

struct border_weld::state {
    state(double tolerance, agreement asked) : agree(std::move(asked)), first(tolerance, agree) {}

    agreement agree;
    first_pass first;
    std::optional<border_point> last_link{};
    lowest_points sets{};
};

border_weld::border_weld(double tolerance, agreement agree) {
    check_tolerance("border_weld", tolerance);
    state_ = std::make_unique<state>(tolerance, std::move(agree));
}
border_weld::~border_weld() = default;
border_weld::border_weld(border_weld&&) noexcept = default;
border_weld& border_weld::operator=(border_weld&&) noexcept = default;

void border_weld::add(const border_point& p, std::span<const std::uint64_t> values, bool outer,
                      tile_result& out) {
    if (p.kind() != border_kind::link) return state_->first.add(p, values, outer, out);
    // Links of one point come one after the other.
    std::optional<border_point>& last = state_->last_link;
    if (last && last->id() == p.id())
        state_->sets.join({last->leader, last->leader_at}, {p.leader, p.leader_at});
    last = p;
}

std::vector<border_point> border_weld::joined() { return state_->sets.flatten(); }

border_point border_weld::handed_on(const border_point& link) const {
    border_point settled = link;
    const auto lowest = state_->sets.lowest({link.leader, link.leader_at});
    settled.leader = lowest.id;
    settled.leader_at = lowest.at;
    return settled;
}

void border_weld::join(const border_point& link) {
    state_->sets.join({link.id(), {}}, {link.leader, link.leader_at});
}

std::uint64_t border_weld::leader_of(std::uint64_t leader) const {
    return state_->sets.lowest({leader, {}}).id;
}

void border_weld::measure(const tile_member& member, longest_move& longest) const {
    longest.consider(member.at, state_->sets.lowest({member.lowest, member.lowest_at}).at);
}

}  // namespace treeform::detail::weld
