#pragma once
/// \file
/// The rule first, of the points of a tile or of the borders of some.

#include <libmesh/weld/near_cells.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/tile_weld.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::weld {

struct kept_point {
    point3 at{};
    std::uint64_t id = 0;
};

/// An open point. It represents all later open points within a fourth of the tolerance.
struct open_point {
    point3 at{};
    std::uint64_t id = 0;
    std::uint64_t stands_in = 0;  ///< set of bundles of the points it represents
    /// Set of bundles with points of other slices whose state may depend on this point or on those
    /// that it represents.
    std::uint64_t asked_by = 0;

    [[nodiscard]] bool stands() const { return stands_in != 0; }
};

/// Points that a pass keeps, with their values.
template <class Point>
struct remembered {
    near_cells<Point> cells;
    std::vector<std::uint64_t> values{};  ///< in the order of the entries of `cells`

    void add(const Point& point, std::span<const std::uint64_t> its_values, std::uint64_t salt) {
        cells.add(point, salt);
        values.insert(values.end(), its_values.begin(), its_values.end());
    }
    [[nodiscard]] std::span<const std::uint64_t> values_of(std::size_t number,
                                                           std::size_t width) const {
        return std::span(values).subspan(number * width, width);
    }
};

/// The rule first, of the points of a tile or of the borders of some.
class first_pass {
  public:
    first_pass(double tolerance, const agreement& agree, const number_slices& slices)
        : agree_(agree),
          slices_(slices),
          within_(tolerance),
          within_more_(reach_of_open(tolerance)),
          within_fourth_(within_more_.distance() > tolerance ? 0.25 * tolerance : 0.0),
          within_half_(2.0 * within_fourth_.distance()),  // which denormals round
          kept_{near_cells<kept_point>(within_.distance(), agree.size() > 0)},
          open_{near_cells<open_point>(within_more_.distance(), agree.size() > 0)} {}

    void reserve(std::size_t points) {
        kept_.cells.reserve(points);
        kept_.values.reserve(points * agree_.size());
        open_.cells.reserve_entries(points);
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
                        .provisional = p.kind() == border_kind::provisional ? &p : nullptr};
        if (p.kind() == border_kind::kept)
            keep(a, out);
        else
            add(a, out);
    }

    /// As `border_weld`.
    void receive(const border_point& p, std::span<const std::uint64_t> values) {
        const std::uint64_t salt = agree_.salt(values.data());
        if (p.kind() == border_kind::kept) {
            kept_.add({.at = p.at, .id = p.id()}, values, salt);
            received_ = kept_.cells.size();
            return;
        }
        open_.add({.at = p.at, .id = p.id(), .stands_in = p.leader}, values, salt);
        is_news_.push_back(false);
    }

    /// See `border_weld`. An open point within a fourth of the tolerance of `asked` may be
    /// represented by another one within a fourth of the tolerance of it. Received points are not
    /// handed over again, unless they have come to represent points of another bundle since.
    void hand_over(const asked_point& asked, std::span<const std::uint64_t> values,
                   std::vector<border_point>& known) {
        const std::uint64_t salt = agree_.salt(values.data());
        const auto is_same = [&](const std::vector<std::uint64_t>& all, std::size_t number) {
            return agree_.same(values.data(), all.data() + number * agree_.size());
        };
        kept_.cells.visit(asked.at, salt, [&](const kept_point& q, std::size_t number) {
            if (number >= received_ && slices_.bundle_of(q.id) == asked.bundle &&
                within_fourth_.holds(asked.at, q.at) && is_same(kept_.values, number))
                known.push_back({border_point::make(q.id, border_kind::kept).tag, q.at, 0, {}});
        });
        open_.cells.visit(asked.at, salt, [&](const open_point& q, std::size_t number) {
            const reach& near = q.stands() ? within_half_ : within_fourth_;
            if (number_slices::has(bundles_of(q), asked.bundle) && is_news(number) &&
                near.holds(asked.at, q.at) && is_same(open_.values, number))
                known.push_back(
                    {border_point::make(q.id, border_kind::open).tag, q.at, q.stands_in, {}});
        });
    }

    /// As `border_weld`.
    [[nodiscard]] bool put_asked(tile_result& out) {
        constexpr std::size_t piece = std::size_t{1} << 16;
        if (bundle_asked_ == 0 && next_asked_ == 0) list_asked();
        const std::size_t end = std::min(asked_.size(), next_asked_ + piece);
        for (; next_asked_ < end; ++next_asked_) {
            const std::uint32_t number = asked_[next_asked_];
            const open_point& p = open_.cells[number];
            const std::uint64_t later = slices_.after(bundle_asked_, p.asked_by);
            if (later == 0 || !number_slices::has(bundles_of(p), bundle_asked_)) continue;
            out.asked.push_back({bundle_asked_, p.at, later});
            const auto values = open_.values_of(number, agree_.size());
            out.asked_values.insert(out.asked_values.end(), values.begin(), values.end());
        }
        if (next_asked_ == asked_.size()) {
            next_asked_ = 0;
            ++bundle_asked_;
        }
        return bundle_asked_ < number_slices::bundles;
    }

  private:
    /// The bundles of an open point and of those it represents.
    [[nodiscard]] std::uint64_t bundles_of(const open_point& p) const {
        return p.stands_in | slices_.bit_of(p.id);
    }
    void list_asked() {
        for (std::uint32_t number = 0; number < open_.cells.size(); ++number)
            if (open_.cells[number].asked_by != 0) asked_.push_back(number);
    }
    [[nodiscard]] bool is_news(std::size_t number) const {
        return number >= is_news_.size() || is_news_[number];
    }
    void stand_in(std::uint32_t number, std::uint64_t id) {
        open_point& q = open_.cells[number];
        const std::uint64_t bit = slices_.bit_of(id);
        if (number < is_news_.size() && (q.stands_in & bit) == 0) is_news_[number] = true;
        q.stands_in |= bit;
    }

    struct arrival {
        std::uint64_t id;
        const point3& at;
        const std::uint64_t* values;
        std::uint64_t salt;
        bool own = true;
        bool shared = false;  ///< other tiles need it
        bool unsure = false;  ///< this pass may not have all of its neighbors
        const border_point* provisional = nullptr;
    };

    void add(const arrival& a, tile_result& out) {
        const neighbors around = look(a);
        if (around.kept.any()) {
            if (a.own) drop(a, around, out);
        } else if (!a.own || a.unsure || around.some_open) {
            if (a.own) put(at(a, border_kind::open), a, out);
            if (around.covering)
                stand_in(*around.covering, a.id);
            else
                open_.add({.at = a.at, .id = a.id}, values_of(a), a.salt);
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
        nearest_kept open;  ///< of the open points that represent only themselves
        /// rounded squared distance of the nearest other open point; or infinity
        double standing_square;
        bool some_open;
        std::optional<std::uint32_t> covering;  ///< number in `open_`
    };

    /// The numbers of the points that `q` represents lie between its number and that of the newest
    /// point. If these two are in one slice, one run has all of them.
    void ask_for(open_point& q, const arrival& a) const {
        if (slices_.slice_of(q.id) != slices_.slice_of(a.id)) q.asked_by |= slices_.bit_of(a.id);
    }

    neighbors look(const arrival& a) {
        const point3& p = a.at;
        neighbors found{nearest_kept(p), nearest_kept(p), infinity, false, {}};
        if (a.provisional != nullptr)
            found.kept.consider(a.provisional->leader, a.provisional->leader_at);
        const auto agrees = [&](const std::vector<std::uint64_t>& values, std::size_t number) {
            return agree_.holds(a.values, values.data() + number * agree_.size());
        };
        kept_.cells.visit(p, a.salt, [&](const kept_point& q, std::size_t number) {
            if (within_.holds(p, q.at) && agrees(kept_.values, number))
                found.kept.consider(q.id, q.at);
        });
        met_open_.clear();
        open_.cells.visit(p, a.salt, [&](open_point& q, std::uint32_t number) {
            if (!(q.stands() ? within_more_ : within_).holds(p, q.at)) return;
            if (!agrees(open_.values, number)) return;
            found.some_open = true;
            if (found.kept.any())
                met_open_.push_back(number);
            else if (a.own)
                ask_for(q, a);
            if (q.stands())
                found.standing_square = std::min(
                    {found.standing_square, rounded_squared_distance(p, q.at), largest_square});
            else
                found.open.consider(q.id, q.at);
            if (within_fourth_.holds(p, q.at) &&
                agree_.same(a.values, open_.values.data() + number * agree_.size()))
                found.covering = number;
        });
        return found;
    }

    void drop(const arrival& a, const neighbors& around, tile_result& out) {
        const nearest_kept& kept = around.kept;
        if (!a.unsure && !open_may_precede(a.at, around)) {
            out.dropped.push_back({a.id, kept.id()});
            out.move.consider(a.at, kept.at());
            return;
        }
        border_point provisional = at(a, border_kind::provisional);
        provisional.leader = kept.id();
        provisional.leader_at = kept.at();
        put(provisional, a, out);
        for (const std::uint32_t number : met_open_) ask_for(open_.cells[number], a);
    }

    /// A point that an open point represents may be nearer than it by a fourth of the tolerance.
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
    number_slices slices_;
    reach within_;
    reach within_more_;
    reach within_fourth_;
    reach within_half_;
    remembered<kept_point> kept_;
    remembered<open_point> open_;
    /// numbers in `open_` of the points met by the dropped one
    std::vector<std::uint32_t> met_open_{};
    std::vector<std::uint32_t> asked_{};  ///< numbers in `open_` of the points asked for
    std::size_t received_ = 0;            ///< number of kept points received
    std::vector<bool> is_news_{};         ///< for the open points received
    std::size_t bundle_asked_ = 0;
    std::size_t next_asked_ = 0;
};

}  // namespace treeform::detail::weld
