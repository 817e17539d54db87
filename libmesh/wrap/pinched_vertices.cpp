#include <libmesh/base/point_math.hpp>
#include <libmesh/wrap/pinched_vertices.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace treeform::detail::wrap {
namespace {

class filling {
  public:
    explicit filling(carved_space& space)
        : space_(space),
          place_(space.cells.size(), tetrahedralization::none),
          waits_(space.cells.points().size(), 0) {
        list_tetrahedra();
    }

    std::uint64_t run() {
        for (std::uint32_t v = 0; v < waits_.size(); ++v) wait(v);
        while (!waiting_.empty()) {
            const std::uint32_t v = waiting_.front();
            waiting_.pop_front();
            waits_[v] = 0;
            look_at(v);
        }
        return filled_;
    }

  private:
    /// Tetrahedra around a corner that are linked by faces at it, all of them inside or none.
    struct piece {
        bool is_outside = false;
        double volume = 0.0;
        std::vector<std::uint32_t> of;  ///< places in `around_`
    };

    void list_tetrahedra() {
        const tetrahedralization& cells = space_.cells;
        begin_.assign(cells.points().size() + 1, 0);
        const auto each = [&](const auto& body) {
            for (std::uint32_t t = 0; t < cells.size(); ++t)
                if (cells.is_used(t))
                    for (const std::uint32_t v : cells[t].corners) body(v, t);
        };
        each([&](std::uint32_t v, std::uint32_t) { ++begin_[v + 1]; });
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
        list_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        each([&](std::uint32_t v, std::uint32_t t) { list_[next[v]++] = t; });
    }

    void wait(std::uint32_t v) {
        if (std::exchange(waits_[v], 1) == 0) waiting_.push_back(v);
    }

    [[nodiscard]] double volume(std::uint32_t t) const {
        using namespace base;
        const auto [a, b, c, d] = space_.cells.corners(t);
        return std::abs(dot(cross(minus(b, a), minus(c, a)), minus(d, a)));
    }

    /// Of `around_[k]`, across its faces at the corner `v`: calls `body` with places in `around_`.
    template <class Body>
    void for_neighbors(std::uint32_t v, std::size_t k, const Body& body) const {
        const tetrahedron& t = space_.cells[around_[k]];
        for (std::size_t i = 0; i < 4; ++i)
            if (t.corners[i] != v && t.neighbors[i] != tetrahedralization::none)
                body(place_[t.neighbors[i]]);
    }

    std::vector<piece> pieces_of(std::uint32_t v) const {
        std::vector<piece> pieces;
        std::vector<std::uint8_t> is_visited(around_.size(), 0);
        for (std::uint32_t first = 0; first < around_.size(); ++first) {
            if (is_visited[first] != 0) continue;
            const std::uint8_t kind = space_.is_outside[around_[first]];
            piece found{kind != 0, 0.0, {first}};
            is_visited[first] = 1;
            for (std::size_t k = 0; k < found.of.size(); ++k) {
                found.volume += volume(around_[found.of[k]]);
                for_neighbors(v, found.of[k], [&](std::uint32_t next) {
                    if (is_visited[next] != 0 || space_.is_outside[around_[next]] != kind) return;
                    is_visited[next] = 1;
                    found.of.push_back(next);
                });
            }
            pieces.push_back(std::move(found));
        }
        return pieces;
    }

    void fill(std::uint32_t t) {
        space_.is_outside[t] = 0;
        ++filled_;
        for (const std::uint32_t v : space_.cells[t].corners) wait(v);
    }

    /// The shortest way from a piece inside to another one.
    void bridge(std::uint32_t v, const piece& from) {
        std::vector<std::uint32_t> before(around_.size(), tetrahedralization::none);
        std::vector<std::uint32_t> row = from.of;
        for (const std::uint32_t k : row) before[k] = k;
        for (std::size_t at = 0; at < row.size(); ++at) {
            const std::uint32_t here = row[at];
            if (before[here] != here && space_.is_outside[around_[here]] == 0) {
                for (std::uint32_t k = before[here]; before[k] != k; k = before[k])
                    fill(around_[k]);
                return;
            }
            for_neighbors(v, here, [&](std::uint32_t next) {
                if (before[next] != tetrahedralization::none) return;
                before[next] = here;
                row.push_back(next);
            });
        }
    }

    /// On the sphere around a corner, where both are of one piece each, one curve is between them.
    void look_at(std::uint32_t v) {
        around_.assign(list_.begin() + static_cast<std::ptrdiff_t>(begin_[v]),
                       list_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]));
        for (std::uint32_t k = 0; k < around_.size(); ++k) place_[around_[k]] = k;
        const std::vector<piece> pieces = pieces_of(v);
        const piece* outer = nullptr;
        const piece* inner = nullptr;
        std::size_t outer_pieces = 0;
        std::size_t inner_pieces = 0;
        for (const piece& p : pieces) {
            const piece*& largest = p.is_outside ? outer : inner;
            ++(p.is_outside ? outer_pieces : inner_pieces);
            if (largest == nullptr || largest->volume < p.volume) largest = &p;
        }
        if (outer_pieces > 1) {
            for (const piece& p : pieces)
                if (p.is_outside && &p != outer)
                    for (const std::uint32_t k : p.of) fill(around_[k]);
        } else if (outer_pieces == 1 && inner_pieces > 1) {
            bridge(v, *inner);
        }
    }

    carved_space& space_;
    std::vector<std::size_t> begin_{};     ///< [V + 1] into `list_`
    std::vector<std::uint32_t> list_{};    ///< tetrahedra by corner
    std::vector<std::uint32_t> around_{};  ///< those of the corner looked at
    std::vector<std::uint32_t> place_;     ///< of a tetrahedron in `around_`
    std::vector<std::uint8_t> waits_;
    std::deque<std::uint32_t> waiting_{};
    std::uint64_t filled_ = 0;
};

}  // namespace

std::uint64_t fill_pinched_vertices(carved_space& space) { return filling(space).run(); }

}  // namespace treeform::detail::wrap
