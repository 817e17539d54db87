#include <libmesh/arrange/face_side.hpp>
#include <libmesh/arrange/radial_order.hpp>
#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/propagate_inside.hpp>
#include <libmesh/intersect/point_locator.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <tuple>

namespace treeform::detail::boolean {
namespace {

/// Of a face or point: the operands whose surface it is on, as bits.
using operand_set = std::uint8_t;
constexpr operand_set both = 3;

/// What has been told of a set of faces, as bits.
using told = std::uint8_t;
constexpr told outside = 1, inside = 2, contradiction = 3;

/// A face at an edge between points that are on both surfaces.
struct edge_use {
    std::uint32_t low, high;
    arrange::face_side side;

    friend bool operator<(const edge_use& x, const edge_use& y) {
        return std::tie(x.low, x.high, x.side) < std::tie(y.low, y.high, y.side);
    }
    [[nodiscard]] bool same_edge(const edge_use& e) const { return low == e.low && high == e.high; }
};

/// Sets of points and faces that are in the other operand or not, all alike. The element of a face
/// is its first corner that is not on both surfaces, or else its own.
class finder {
  public:
    finder(const prepared_pair& operands, const near_faces& near, const mesh_arrangement& cut)
        : operands_(operands),
          near_(near),
          cut_(cut),
          points_(cut.given_points.size() + cut.constructed.size()),
          on_(points_),
          covered_(cut.faces.size()),
          alike_(points_ + cut.faces.size()),
          told_(points_ + cut.faces.size(), 0) {}

    std::optional<std::vector<std::uint8_t>> run() {
        if (!find_covers()) return std::nullopt;
        join_at_points();
        if (!look_at_edges()) return std::nullopt;
        if (!ask_rays()) return std::nullopt;
        return answers();
    }

  private:
    [[nodiscard]] std::uint32_t element(std::size_t f) const {
        for (const std::uint32_t p : cut_.faces[f])
            if (on_[p] != both) return p;
        return static_cast<std::uint32_t>(points_ + f);
    }
    [[nodiscard]] bool is_alone(std::size_t f) const { return covered_[f] != both; }

    /// False when an operand covers a face twice.
    bool find_covers() {
        std::fill_n(on_.data(), points_, operand_set{0});
        std::atomic<bool> bad{false};
        for_chunks(cut_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f) {
                           operand_set set = 0;
                           for (const covering_face& cover : cut_.covers_of(f)) {
                               const auto bit =
                                   static_cast<operand_set>(1U << near_.operand_of(cover.face));
                               if ((set & bit) != 0) bad = true;
                               set = static_cast<operand_set>(set | bit);
                           }
                           covered_[f] = set;
                           for (const std::uint32_t p : cut_.faces[f]) {
                               const std::atomic_ref on(on_[p]);
                               if ((on.load(std::memory_order_relaxed) & set) != set)
                                   on.fetch_or(set, std::memory_order_relaxed);
                           }
                       }
                   });
        return !bad;
    }

    /// Near a point that is not on the other surface all is inside or all is outside.
    void join_at_points() {
        for_chunks(cut_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t f = begin; f < end; ++f) {
                           if (!is_alone(f)) continue;
                           const std::uint32_t first = element(f);
                           for (const std::uint32_t p : cut_.faces[f])
                               if (p != first && on_[p] != both) alike_.join(first, p);
                       }
                   });
    }

    /// The edges between points on both surfaces, in parts, all faces at an edge in one part.
    [[nodiscard]] std::vector<std::vector<edge_use>> shared_edges() const {
        std::vector<std::vector<edge_use>> found(chunk_count(cut_.faces.size(), light_grain));
        for_chunks(cut_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                       for (std::size_t f = begin; f < end; ++f)
                           for (std::size_t i = 0; i < 3; ++i) {
                               const std::uint32_t a = cut_.faces[f][i];
                               const std::uint32_t b = cut_.faces[f][i == 2 ? 0 : i + 1];
                               if (on_[a] != both || on_[b] != both) continue;
                               const auto id = static_cast<std::uint32_t>(f);
                               found[chunk].push_back(
                                   {std::min(a, b), std::max(a, b),
                                    a < b ? arrange::front_of(id) : arrange::behind(id)});
                           }
                   });
        std::vector<std::vector<edge_use>> parts(64);
        for (const auto& chunk : found)
            for (const edge_use& use : chunk) parts[use.low % parts.size()].push_back(use);
        return parts;
    }

    bool look_at_edges() {
        std::vector<std::vector<edge_use>> parts = shared_edges();
        std::atomic<bool> bad{false};
        for_chunks(parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
            if (!look_at_edges(parts[i])) bad = true;
        });
        return !bad && settle_told();
    }

    bool look_at_edges(std::vector<edge_use>& uses) {
        std::sort(uses.begin(), uses.end());
        arrange::radial_order radial(near_.local, cut_);
        std::vector<arrange::face_side> sides;
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            const edge_use& first = uses[begin];
            sides.clear();
            for (; end < uses.size() && uses[end].same_edge(first); ++end)
                sides.push_back(uses[end].side);
            if (!look_at_edge({first.low, first.high}, sides, radial)) return false;
        }
        return true;
    }

    /// `sides` are all faces at the edge. False when they contradict each other.
    bool look_at_edge(const std::array<std::uint32_t, 2>& ends,
                      std::vector<arrange::face_side>& sides, arrange::radial_order& radial) {
        operand_set met = 0;
        for (const arrange::face_side side : sides)
            met = static_cast<operand_set>(met | covered_[arrange::face_of(side)]);
        if (met != both) {
            for (const arrange::face_side side : sides)
                alike_.join(element(arrange::face_of(sides[0])), element(arrange::face_of(side)));
            return true;
        }
        if (std::none_of(sides.begin(), sides.end(),
                         [&](arrange::face_side side) { return is_alone(arrange::face_of(side)); }))
            return true;
        if (!radial.sort(ends, sides)) return false;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::uint32_t f = arrange::face_of(sides[i]);
            if (!is_alone(f)) continue;
            const operand_set other = both ^ covered_[f];
            std::size_t j = i;
            do j = j + 1 == sides.size() ? 0 : j + 1;
            while ((covered_[arrange::face_of(sides[j])] & other) == 0);
            tell(element(f), behind_cover(arrange::other_side(sides[j]), other) ? inside : outside);
        }
        return true;
    }

    /// Whether a side of a face looks into operand `other`, which covers it.
    [[nodiscard]] bool behind_cover(arrange::face_side side, operand_set other) const {
        for (const covering_face& cover : cut_.covers_of(arrange::face_of(side)))
            if (1U << near_.operand_of(cover.face) == other)
                return arrange::is_behind(side) != cover.opposite;
        return false;
    }

    void tell(std::uint32_t element, told what) {
        std::atomic_ref(told_[element]).fetch_or(what, std::memory_order_relaxed);
    }

    /// What was told of elements becomes what is told of their sets; false where it contradicts.
    bool settle_told() {
        for (std::uint32_t i = 0; i < told_.size(); ++i)
            if (told_[i] != 0) told_[alike_.root(i)] |= told_[i];
        return std::find(told_.begin(), told_.end(), contradiction) == told_.end();
    }

    /// The sets of faces of which nothing is known, by the lowest element; by the operand that they
    /// may be in.
    [[nodiscard]] std::array<std::vector<std::uint32_t>, 2> unknown_sets() {
        using lists = std::array<std::vector<std::uint32_t>, 2>;
        std::vector<lists> found(chunk_count(cut_.faces.size(), light_grain));
        for_chunks(cut_.faces.size(), light_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                       for (std::size_t f = begin; f < end; ++f) {
                           if (!is_alone(f)) continue;
                           const std::uint32_t root = alike_.root(element(f));
                           auto& list = found[chunk][covered_[f] == 1 ? 1 : 0];
                           if (told_[root] == 0 && (list.empty() || list.back() != root))
                               list.push_back(root);
                       }
                   });
        lists all;
        for (std::size_t k = 0; k < 2; ++k) {
            for (const lists& part : found)
                all[k].insert(all[k].end(), part[k].begin(), part[k].end());
            std::sort(all[k].begin(), all[k].end());
            all[k].erase(std::unique(all[k].begin(), all[k].end()), all[k].end());
        }
        return all;
    }

    /// False where a set has no given point apart from the other surface.
    bool ask_rays() {
        const auto asking = unknown_sets();
        for (const auto& sets : asking)
            for (const std::uint32_t root : sets) {
                if (root >= cut_.given_points.size()) return false;
                told_[root] = outside;
            }
        for (std::size_t k = 0; k < 2; ++k) {
            if (asking[k].empty()) continue;
            const intersect::point_locator locator(operands_[k]->view(),
                                                   build_face_tree(*operands_[k]));
            std::vector<point3> points;
            for (const std::uint32_t p : asking[k]) points.push_back(cut_.given_points[p]);
            const auto found = locator.locate(points);
            for (std::size_t i = 0; i < found.size(); ++i)
                if (found[i].where == location::inside) told_[asking[k][i]] = inside;
        }
        return true;
    }

    std::vector<std::uint8_t> answers() {
        std::vector<std::uint8_t> result(cut_.faces.size());
        for_chunks(
            cut_.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t f = begin; f < end; ++f)
                    result[f] = is_alone(f) && told_[alike_.root(element(f))] == inside ? 1 : 0;
            });
        return result;
    }

    const prepared_pair& operands_;
    const near_faces& near_;
    const mesh_arrangement& cut_;
    std::size_t points_;
    buffer<operand_set> on_;       ///< by point
    buffer<operand_set> covered_;  ///< by face
    base::union_find alike_;       ///< of points, then faces
    std::vector<told> told_;       ///< by element; in the end, by the lowest of a set
};

}  // namespace

std::optional<std::vector<std::uint8_t>> find_insides(const prepared_pair& operands,
                                                      const near_faces& near,
                                                      const mesh_arrangement& cut) {
    return finder(operands, near, cut).run();
}

}  // namespace treeform::detail::boolean
