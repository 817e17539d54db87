#include <libmesh/weld/carried_rows.hpp>
#include <libmesh/weld/first_pass.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/tile_weld.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <unordered_map>
#include <utility>

namespace treeform::detail::weld {
namespace {

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
            append_chain_point({tags_[next_], points_[next_]},
                               {tags_[lowest] >> 2, points_[lowest], elsewhere_[group]}, out);
        }
        return next_ < tags_.size();
    }

  private:
    void group() {
        weld_options options{.tolerance = tolerance_, .chain = true};
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
    struct point_with_id {
        std::uint64_t id = 0;
        point3 at{};
    };

    void join(const point_with_id& a, const point_with_id& b) {
        const point_with_id x = shorten(a);
        const point_with_id y = shorten(b);
        if (x.id != y.id) above_[std::max(x.id, y.id)] = x.id < y.id ? x : y;
    }
    [[nodiscard]] point_with_id lowest(point_with_id a) const {
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
            const point_with_id top = shorten({id, {}});
            links.push_back(border_point::make(id, border_kind::link));
            links.back().leader = top.id;
            links.back().leader_at = top.at;
        }
        return links;
    }

  private:
    /// As `lowest`, and hangs what is on the way directly below it.
    point_with_id shorten(point_with_id a) {
        const point_with_id top = lowest(a);
        for (auto up = above_.find(a.id); up != above_.end(); up = above_.find(a.id)) {
            a = up->second;
            up->second = top;
            if (a.id == top.id) break;
        }
        return top;
    }

    std::unordered_map<std::uint64_t, point_with_id> above_{};
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

tile_weld::tile_weld(bool chain, double tolerance, agreement agree, const number_slices& slices)
    : state_(std::make_unique<state>()) {
    check_tolerance("tile_weld", tolerance);
    state_->agree = std::move(agree);
    if (!chain)
        state_->first.emplace(tolerance, state_->agree, slices);
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

bool tile_weld::finish(tile_result& out) {
    return state_->chain ? state_->chain->finish(out) : state_->first->put_asked(out);
}

struct border_weld::state {
    state(double tolerance, agreement same, const number_slices& slices)
        : agree(std::move(same)), first(tolerance, agree, slices) {}

    agreement agree;
    first_pass first;
    std::optional<border_point> last_link{};
    lowest_points sets{};
};

border_weld::border_weld(double tolerance, agreement agree, const number_slices& slices) {
    check_tolerance("border_weld", tolerance);
    state_ = std::make_unique<state>(tolerance, std::move(agree), slices);
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

void border_weld::receive(const border_point& p, std::span<const std::uint64_t> values) {
    state_->first.receive(p, values);
}

void border_weld::hand_over(const asked_point& asked, std::span<const std::uint64_t> values,
                            std::vector<border_point>& known) {
    state_->first.hand_over(asked, values, known);
}

bool border_weld::finish(tile_result& out) { return state_->first.put_asked(out); }

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
