#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/open_input_edges.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::size_t most_listed = 100;

using stretch_ends = std::array<std::uint32_t, 2>;  // points, ascending

aabb<double, 3> box_of(points_view points, const unbalanced_edge& e) {
    aabb<double, 3> box;
    for (const std::uint32_t p : e.ends) box.include(points[p]);
    return box;
}

/// Edges of one operand in sets: two on one line that have a common point are in one.
std::vector<std::vector<const unbalanced_edge*>> edges_by_line(
    points_view points, std::span<const unbalanced_edge> edges) {
    const tree<3> tree = build(edges, [&](const auto& e) { return box_of(points, e); });
    base::union_find lines(edges.size());
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const std::uint32_t a = edges[i].ends[0], b = edges[i].ends[1];
        search(tree, box_of(points, edges[i]), [&](std::uint32_t j) {
            if (j <= i || edges[j].operand != edges[i].operand) return;
            const auto [c, d] = edges[j].ends;
            if (collinear(points[a], points[b], points[c]) &&
                collinear(points[a], points[b], points[d]))
                lines.join(i, j);
        });
    }
    const arrange::numbered_sets line = arrange::number_sets(std::move(lines));
    std::vector<std::vector<const unbalanced_edge*>> result(line.count());
    for (std::uint32_t i = 0; i < edges.size(); ++i) result[line[i]].push_back(&edges[i]);
    return result;
}

/// The points of a line in order, and how often edges run along it from each to the next.
class line_sum {
  public:
    line_sum(points_view points, const std::vector<const unbalanced_edge*>& edges)
        : points_(points), edges_(edges) {
        for (const unbalanced_edge* e : edges)
            on_.insert(on_.end(), e->ends.begin(), e->ends.end());
        std::ranges::sort(on_, [&](std::uint32_t p, std::uint32_t q) { return is_before(p, q); });
        on_.erase(std::unique(on_.begin(), on_.end()), on_.end());
        sum_.resize(on_.size(), 0);
        for (const unbalanced_edge* e : edges) {
            const auto [low, high] = places(*e);
            const std::int64_t net = on_[low] == e->ends[0] ? e->net : -e->net;
            sum_[low] += net;
            sum_[high] -= net;
        }
        for (std::size_t i = 1; i < sum_.size(); ++i) sum_[i] += sum_[i - 1];
    }

    /// The ends of all stretches.
    [[nodiscard]] std::vector<stretch_ends> stretches() const {
        std::vector<stretch_ends> found;
        for (std::size_t i = 0; i + 1 < on_.size(); ++i)
            if (sum_[i] != 0) {
                const auto [low, high] = std::minmax({on_[i], on_[i + 1]});
                found.push_back({low, high});
            }
        return found;
    }
    /// The lowest face at a stretch of the line.
    [[nodiscard]] std::uint32_t face_at(const stretch_ends& ends) const {
        const std::size_t i = std::min(place(ends[0]), place(ends[1]));
        std::uint32_t lowest = operand_element::none;
        for (const unbalanced_edge* e : edges_) {
            const auto [low, high] = places(*e);
            if (low <= i && i < high) lowest = std::min(lowest, e->face);
        }
        return lowest;
    }
    /// Whether no edge overlaps another one.
    [[nodiscard]] bool is_plain() const {
        return std::ranges::all_of(edges_, [&](const unbalanced_edge* e) {
            const auto [low, high] = places(*e);
            return high == low + 1 && (sum_[low] == e->net || sum_[low] == -e->net);
        });
    }

  private:
    [[nodiscard]] bool is_before(std::uint32_t p, std::uint32_t q) const {
        return geometry::lexicographically_less(points_[p], points_[q]);
    }
    [[nodiscard]] std::size_t place(std::uint32_t p) const {
        return static_cast<std::size_t>(
            std::ranges::lower_bound(
                on_, p, [&](std::uint32_t x, std::uint32_t y) { return is_before(x, y); }) -
            on_.begin());
    }
    [[nodiscard]] std::pair<std::size_t, std::size_t> places(const unbalanced_edge& e) const {
        return std::minmax({place(e.ends[0]), place(e.ends[1])});
    }
    points_view points_;
    const std::vector<const unbalanced_edge*>& edges_;
    std::vector<std::uint32_t> on_;
    std::vector<std::int64_t> sum_;  ///< [on_] from each to the next
};

}  // namespace

open_input_edges find_open_input_edges(points_view points,
                                       std::span<const unbalanced_edge> unbalanced) {
    open_input_edges found;
    if (unbalanced.empty()) return found;
    bool is_plain = true;
    const auto lines = edges_by_line(points, unbalanced);
    struct stretch {
        stretch_ends ends;
        std::size_t line;
    };
    std::vector<stretch> all;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const line_sum sum(points, lines[i]);
        for (const stretch_ends& ends : sum.stretches()) all.push_back({ends, i});
        is_plain = is_plain && sum.is_plain();
    }
    found.count = all.size();
    const auto some = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_listed));
    std::ranges::partial_sort(all, some, {},
                              [](const stretch& s) { return std::pair(s.ends, s.line); });
    for (auto s = all.begin(); s != some; ++s)
        found.stretches.push_back({line_sum(points, lines[s->line]).face_at(s->ends), s->ends});
    if (is_plain)
        for (const unbalanced_edge& e : unbalanced)
            ++(e.net % 2 == 0 ? found.misoriented_edges : found.boundary_edges);
    return found;
}

}  // namespace treeform::detail::boolean
