#include <libmesh/cut/nested_loops.hpp>
#include <treeform/mesh/section.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace treeform::detail::cut {
namespace {

/// From how many points of a loop lines are tried that meet no other loop in the point itself.
constexpr std::size_t most_tries = 16;

/// Counts the sides that lines down from points of loops cross, in a projection along an axis.
class loop_nester {
  public:
    loop_nester(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                const layer_loops& layer, std::span<const point3> centers, double radius)
        : mesh_(mesh), levels_(levels), k_(k), layer_(layer), centers_(centers), radius_(radius) {
        for (int i = 1; i < 3; ++i)
            if (std::abs(levels.normal[static_cast<std::size_t>(i)]) >
                std::abs(levels.normal[static_cast<std::size_t>(axis_)]))
                axis_ = i;
        x_ = (axis_ + 1) % 3;
        y_ = (axis_ + 2) % 3;
        for (std::uint32_t l = 0; l < layer.loops.size(); ++l)
            if (layer.loops[l].closed) closed_.push_back(l);
    }

    std::vector<nesting> find() {
        std::vector<nesting> result(layer_.loops.size(), {section_loop::none, 0});
        if (closed_.size() < 2) return result;
        std::vector<std::vector<std::uint32_t>> around(layer_.loops.size());
        std::vector<std::uint32_t> asked = closed_;
        for (std::size_t tries = 0; !asked.empty(); ++tries) asked = ask(asked, tries, around);
        for (const std::uint32_t l : closed_)
            result[l].depth = static_cast<std::uint32_t>(around[l].size());
        for (const std::uint32_t l : closed_)
            for (const std::uint32_t m : around[l])
                if (result[l].parent == section_loop::none ||
                    result[m].depth > result[result[l].parent].depth)
                    result[l].parent = m;
        return result;
    }

  private:
    struct query {
        std::uint32_t loop;
        point3 near;           ///< where the point is, nearly
        implicit_point exact;  ///< or there, exactly
        bool touches = false;
        std::vector<std::uint32_t> crossed{};  ///< the loop of each side below
    };

    [[nodiscard]] double x(const point3& p) const { return p[static_cast<std::size_t>(x_)]; }
    [[nodiscard]] double y(const point3& p) const { return p[static_cast<std::size_t>(y_)]; }
    [[nodiscard]] implicit_point exact(std::size_t point) const {
        return exact_point(mesh_, levels_, k_, layer_.points[point]);
    }

    /// A point of the loop: at last, where all that were tried are on other loops, the middle of
    /// its longest side, rounded.
    [[nodiscard]] query query_of(std::uint32_t l, std::size_t tries) const {
        const layer_loops::loop& loop = layer_.loops[l];
        if (tries < std::min(most_tries, loop.count)) {
            const std::size_t p =
                loop.first + tries * loop.count / std::min(most_tries, loop.count);
            return {l, centers_[p], exact(p)};
        }
        point3 middle{};
        double longest = -1.0;
        for (std::size_t i = 0; i < loop.count; ++i) {
            const point3& a = centers_[loop.first + i];
            const point3& b = centers_[loop.first + (i + 1) % loop.count];
            const double length = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
            if (std::exchange(longest, std::max(longest, length)) < length)
                middle = {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2, a.z + (b.z - a.z) / 2};
        }
        return {l, middle, middle};
    }

    /// Sets what is around the loops `asked`; those of which a point is on another loop are
    /// returned.
    std::vector<std::uint32_t> ask(const std::vector<std::uint32_t>& asked, std::size_t tries,
                                   std::vector<std::vector<std::uint32_t>>& around) const {
        std::vector<query> queries;
        for (const std::uint32_t l : asked) queries.push_back(query_of(l, tries));
        std::ranges::stable_sort(queries, {}, [&](const query& q) { return x(q.near); });
        for (const std::uint32_t l : closed_) ask_about(l, queries);
        std::vector<std::uint32_t> again;
        for (query& q : queries) {
            if (q.touches && tries < std::min(most_tries, layer_.loops[q.loop].count)) {
                again.push_back(q.loop);
                continue;
            }
            std::ranges::sort(q.crossed);
            for (auto i = q.crossed.begin(); i != q.crossed.end();) {
                const auto end = std::upper_bound(i, q.crossed.end(), *i);
                if ((end - i) % 2 == 1) around[q.loop].push_back(*i);
                i = end;
            }
        }
        std::ranges::sort(again);
        return again;
    }

    /// What loop l is around, of the points of other loops: those within its box.
    void ask_about(std::uint32_t l, std::vector<query>& queries) const {
        const layer_loops::loop& loop = layer_.loops[l];
        const double off = 2 * radius_;
        double left = x(centers_[loop.first]), right = left;
        double low = y(centers_[loop.first]), high = low;
        for (const point3& p : centers_.subspan(loop.first, loop.count)) {
            left = std::min(left, x(p)), right = std::max(right, x(p));
            low = std::min(low, y(p)), high = std::max(high, y(p));
        }
        std::vector<query*> asked;  // by x
        auto q = std::ranges::lower_bound(queries, left - off, {},
                                          [&](const query& one) { return x(one.near); });
        for (; q != queries.end() && x(q->near) <= right + off; ++q)
            if (q->loop != l && low - off <= y(q->near) && y(q->near) <= high + off)
                asked.push_back(&*q);
        if (asked.empty()) return;
        const auto place = [&](const query* one) { return x(one->near); };
        for (std::size_t i = 0; i < loop.count; ++i) {
            const std::size_t p = loop.first + i;
            const std::size_t r = i + 1 == loop.count ? loop.first : p + 1;
            const double from = std::min(x(centers_[p]), x(centers_[r]));
            const double to = std::max(x(centers_[p]), x(centers_[r]));
            for (auto one = std::ranges::lower_bound(asked, from - off, {}, place);
                 one != asked.end() && place(*one) <= to + off; ++one)
                cross(**one, l, p, r);
        }
    }

    /// Notes whether the line down from q crosses the side from p to r. A side has its ends at or
    /// before q in x, or not, so that each end counts for one side of two.
    void cross(query& q, std::uint32_t loop, std::size_t p, std::size_t r) const {
        const double off = 2 * radius_;
        const point3 &a = centers_[p], &b = centers_[r];
        if (std::min(y(a), y(b)) - off > y(q.near)) return;
        const bool clear = std::abs(x(a) - x(q.near)) > off && std::abs(x(b) - x(q.near)) > off;
        if (clear && std::max(y(a), y(b)) + off < y(q.near)) {
            if ((x(a) < x(q.near)) != (x(b) < x(q.near))) q.crossed.push_back(loop);
            return;
        }
        const implicit_point first = exact(p), second = exact(r);
        const int from = compare(x_, first, q.exact), to = compare(x_, second, q.exact);
        if (from == 0) {
            const int up = compare(y_, first, q.exact);
            q.touches |= up == 0 || (to == 0 && up * compare(y_, second, q.exact) <= 0);
        }
        if ((from <= 0) == (to <= 0)) return;
        const int turn = from <= 0 ? orient2d(axis_, first, second, q.exact)
                                   : orient2d(axis_, second, first, q.exact);
        q.touches |= turn == 0;
        if (turn > 0) q.crossed.push_back(loop);
    }

    mesh_view mesh_;
    const plane_levels& levels_;
    std::uint32_t k_;
    const layer_loops& layer_;
    std::span<const point3> centers_;
    double radius_;
    int axis_ = 0, x_ = 0, y_ = 0;  ///< the axis that is left out, and those that are kept
    std::vector<std::uint32_t> closed_;
};

}  // namespace

std::vector<nesting> nested_loops(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                                  const layer_loops& layer, std::span<const point3> centers,
                                  double radius) {
    return loop_nester(mesh, levels, k, layer, centers, radius).find();
}

}  // namespace treeform::detail::cut
