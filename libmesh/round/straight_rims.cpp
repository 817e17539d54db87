#include <libmesh/base/point_math.hpp>
#include <libmesh/round/straight_rims.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::round {
namespace {

using point_numbers = std::vector<std::uint32_t>;

/// A side that one part has on its left, and one other on its right.
struct shared_side {
    rim_side ends;
    std::uint32_t left, right;
};

class straightening {
  public:
    straightening(std::vector<std::vector<rim_side>>& rims, std::span<const point3> points,
                  std::vector<std::uint8_t> stays, std::span<const std::uint8_t> may, double reach)
        : rims_(rims), points_(points), stays_(std::move(stays)), reach_(reach) {
        find_shared(may);
        for (const shared_side& s : shared_) {
            const auto here = sides_at(s.ends[0]);
            if (here.size() != 2 || here[0].left != here[1].right || here[0].right != here[1].left)
                stays_[s.ends[0]] = 1;
        }
        seen_.assign(shared_.size(), 0);
    }

    void run() {
        for (std::vector<rim_side>& rim : rims_)
            std::erase_if(rim, [&](const rim_side& s) {
                return std::ranges::any_of(sides_at(s[0]),
                                           [&](const shared_side& e) { return e.ends == s; });
            });
        for (const bool from_its_end : {true, false})  // then those that end nowhere
            for (std::size_t i = 0; i < shared_.size(); ++i)
                if (seen_[i] == 0 && (!from_its_end || stays_[shared_[i].ends[0]] != 0)) walk(i);
    }

  private:
    void find_shared(std::span<const std::uint8_t> may) {
        std::vector<std::pair<rim_side, std::uint32_t>> all;
        for (std::uint32_t part = 0; part < rims_.size(); ++part)
            for (const rim_side& s : rims_[part]) all.emplace_back(s, part);
        std::ranges::sort(all);
        const auto parts_at = [&](const rim_side& s) {
            constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
            return std::span(std::lower_bound(all.begin(), all.end(), std::pair{s, 0U}),
                             std::upper_bound(all.begin(), all.end(), std::pair{s, last}));
        };
        for (const auto& [ends, part] : all) {
            const auto mine = parts_at(ends), others = parts_at({ends[1], ends[0]});
            if (mine.size() == 1 && others.size() == 1 && may[part] != 0 &&
                may[others.front().second] != 0)
                shared_.push_back({ends, part, others.front().second});
            else
                stays_[ends[0]] = stays_[ends[1]] = 1;
        }
    }

    [[nodiscard]] std::span<const shared_side> sides_at(std::uint32_t from) const {
        const auto is_before = [](const shared_side& s, std::uint32_t p) { return s.ends[0] < p; };
        const auto begin = std::lower_bound(shared_.begin(), shared_.end(), from, is_before);
        return {begin, std::lower_bound(begin, shared_.end(), from + 1, is_before)};
    }
    [[nodiscard]] std::size_t number(const shared_side& s) const {
        return static_cast<std::size_t>(&s - shared_.data());
    }

    /// On from a side until a point stays, or where it began; then both parts get what is left.
    void walk(std::size_t first) {
        const std::uint32_t left = shared_[first].left, right = shared_[first].right;
        point_numbers way(1, shared_[first].ends[0]);
        for (std::size_t i = first; seen_[i] == 0;) {
            seen_[i] = 1;
            const auto [from, to] = shared_[i].ends;
            way.push_back(to);
            const std::span<const shared_side> here = sides_at(to);
            for (const shared_side& back : here)
                if (back.ends[1] == from) seen_[number(back)] = 1;
            if (stays_[to] != 0) break;
            i = number(here[0].left == left ? here[0] : here[1]);
        }
        way = simplified(way);
        for (std::size_t k = 0; k + 1 < way.size(); ++k) {
            rims_[left].push_back({way[k], way[k + 1]});
            rims_[right].push_back({way[k + 1], way[k]});
        }
    }

    [[nodiscard]] point_numbers simplified(const point_numbers& all) const {
        std::vector<std::uint8_t> keep(all.size(), 0);
        keep.front() = keep.back() = 1;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, all.size() - 1}};
        while (!open.empty()) {
            const auto [begin, end] = open.back();
            open.pop_back();
            std::size_t furthest = begin;
            double most = reach_;
            for (std::size_t i = begin + 1; i < end; ++i) {
                const double d =
                    distance_to_edge(points_[all[i]], points_[all[begin]], points_[all[end]]);
                if (d > most) furthest = i;
                most = std::max(most, d);
            }
            if (furthest == begin) continue;
            keep[furthest] = 1;
            open.emplace_back(begin, furthest);
            open.emplace_back(furthest, end);
        }
        point_numbers kept;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (keep[i] != 0) kept.push_back(all[i]);
        return all.front() == all.back() && kept.size() < 4 ? all : kept;
    }

    std::vector<std::vector<rim_side>>& rims_;
    std::span<const point3> points_;
    std::vector<std::uint8_t> stays_;
    double reach_;
    std::vector<shared_side> shared_{};  ///< ascending
    std::vector<std::uint8_t> seen_{};
};

}  // namespace

std::vector<rim_side> without_opposites(const std::vector<rim_side>& sides) {
    std::vector<rim_side> sorted(sides), left;
    std::ranges::sort(sorted);
    for (std::size_t i = 0, next = 0; i < sorted.size(); i = next) {
        next = i;
        while (next < sorted.size() && sorted[next] == sorted[i]) ++next;
        const auto [first, last] =
            std::equal_range(sorted.begin(), sorted.end(), rim_side{sorted[i][1], sorted[i][0]});
        const auto back = static_cast<std::size_t>(last - first);
        for (std::size_t k = back; k < next - i; ++k) left.push_back(sorted[i]);
    }
    return left;
}

double distance_to_edge(const point3& p, const point3& a, const point3& b) {
    const point3 way = base::minus(b, a), to = base::minus(p, a);
    const double square = base::dot(way, way);
    const double along = square > 0.0 ? std::clamp(base::dot(to, way) / square, 0.0, 1.0) : 0.0;
    const point3 off = base::minus(to, base::scaled(way, along));
    return std::sqrt(base::dot(off, off));
}

void straighten(std::vector<std::vector<rim_side>>& rims, std::span<const point3> points,
                std::vector<std::uint8_t> stays, std::span<const std::uint8_t> may, double reach) {
    straightening(rims, points, std::move(stays), may, reach).run();
}

}  // namespace treeform::detail::round
