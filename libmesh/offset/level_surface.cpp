#include <libmesh/base/point_math.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <libmesh/offset/level_surface.hpp>
#include <libmesh/offset/near_places.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::offset {
namespace {

/// Corners of the six tetrahedra of a cube, as bits of axes: counter-clockwise, as `orient3d` has
/// it.
constexpr std::array<std::array<unsigned, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// An edge between corners of a cube, by the lower one, and the axes along which the other is up.
using edge_key = std::uint64_t;

constexpr double end_share = 0x1p-10;  ///< of an edge, at its ends: no vertex is there
constexpr double precise = 0x1p-12;    ///< of a step: so near is near enough
constexpr int most_tries = 24;

class builder {
  public:
    builder(const prepared_mesh& mesh, const cell_grid& grid, double distance, bool near_is_behind,
            const progress_callback& progress)
        : nearest_(nearness::closest_point_query_of(mesh)),
          grid_(grid),
          distance_(distance),
          near_is_behind_(near_is_behind),
          progress_(progress) {}

    mesh run() {
        if (!find_heights()) return {};
        for (const lattice_key cell : grid_.cells) cut(cell);
        return numbered();
    }

  private:
    [[nodiscard]] bool may_continue(double done) const { return !progress_ || progress_(done); }

    /// How much further than the distance corners of cells are. False when it is to stop.
    bool find_heights() {
        corners_.reserve(8 * grid_.cells.size());
        for (const lattice_key cell : grid_.cells)
            for (unsigned c = 0; c < 8; ++c) corners_.push_back(cell_grid::corner_of(cell, c));
        std::sort(corners_.begin(), corners_.end());
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
        corners_.shrink_to_fit();
        std::vector<point3> places(corners_.size());
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = grid_.point(corners_[i]);
        const auto found =
            near_places(nearest_, places, [&](double done) { return may_continue(0.4 * done); });
        heights_.reserve(places.size());
        for (const auto& near : found) heights_.push_back(near->distance - distance_);
        return found.size() == places.size();
    }

    [[nodiscard]] double height(lattice_key corner) const {
        const auto at = std::lower_bound(corners_.begin(), corners_.end(), corner);
        return heights_[static_cast<std::size_t>(at - corners_.begin())];
    }

    void cut(lattice_key cell) {
        unsigned behind = 0;
        for (unsigned c = 0; c < 8; ++c)
            if ((height(cell_grid::corner_of(cell, c)) < 0.0) == near_is_behind_) behind |= 1U << c;
        if (behind == 0 || behind == 0xff) return;
        for (const auto& t : tetrahedra) cut(cell, t, behind);
    }

    void cut(lattice_key cell, std::array<unsigned, 4> t, unsigned behind) {
        const auto is_behind = [&](unsigned c) { return (behind >> c & 1) != 0; };
        const auto count = std::count_if(t.begin(), t.end(), is_behind);
        if (count == 0 || count == 4) return;
        // Those behind come first; of three, the one in front.
        bool turned = count == 3;
        std::size_t first = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (is_behind(t[i]) == (count == 3)) continue;
            if (i != first) {
                std::swap(t[i], t[first]);
                turned = !turned;
            }
            ++first;
        }
        const auto edge = [&](std::size_t i, std::size_t j) {
            const unsigned low = std::min(t[i], t[j]), other = std::max(t[i], t[j]);
            return cell_grid::corner_of(cell, low) << 3 | (low ^ other);
        };
        const auto add = [&](edge_key a, edge_key b, edge_key c) {
            if (turned) std::swap(b, c);
            triangles_.push_back({a, b, c});
        };
        if (first == 1) {
            add(edge(0, 1), edge(0, 2), edge(0, 3));
        } else {
            const edge_key near = edge(0, 2), far = edge(1, 3);
            add(near, edge(0, 3), far);
            add(near, far, edge(1, 2));
        }
    }

    /// Where an edge is at the distance.
    [[nodiscard]] point3 vertex_on(edge_key edge) const {
        const lattice_key low = edge >> 3;
        const lattice_key high = cell_grid::corner_of(low, static_cast<unsigned>(edge & 7));
        const point3 from = grid_.point(low), way = base::minus(grid_.point(high), from);
        const auto at = [&](double share) { return base::plus(from, base::scaled(way, share)); };
        double begin = 0.0, end = 1.0, first = height(low), last = height(high);
        double share = 0.5;
        for (int tries = 0; tries < most_tries; ++tries) {
            // The chord's root, and now and then the middle, where that is slow.
            share = tries % 3 == 2 ? 0.5 * (begin + end)
                                   : begin + (end - begin) * (first / (first - last));
            const double now = nearest_.nearest(at(share))->distance - distance_;
            if (std::abs(now) <= precise * grid_.step) break;
            if ((now < 0.0) == (first < 0.0)) {
                begin = share;
                first = now;
            } else {
                end = share;
                last = now;
            }
        }
        return at(std::clamp(share, end_share, 1.0 - end_share));
    }

    mesh numbered() {
        std::vector<edge_key> edges;
        edges.reserve(3 * triangles_.size());
        for (const auto& t : triangles_) edges.insert(edges.end(), t.begin(), t.end());
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        mesh result;
        result.points.resize(edges.size());
        constexpr std::size_t grain = 64, block = std::size_t{1} << 15;
        for (std::size_t first = 0; first < edges.size(); first += block) {
            const std::size_t count = std::min(block, edges.size() - first);
            for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t i = first + begin; i < first + end; ++i)
                    result.points[i] = vertex_on(edges[i]);
            });
            if (!may_continue(0.4 + 0.6 * static_cast<double>(first + count) /
                                        static_cast<double>(edges.size())))
                return {};
        }
        const auto number = [&](edge_key e) {
            return static_cast<std::uint32_t>(std::lower_bound(edges.begin(), edges.end(), e) -
                                              edges.begin());
        };
        result.faces.reserve(triangles_.size());
        for (const auto& [a, b, c] : triangles_)
            result.faces.push_back({number(a), number(b), number(c)});
        return result;
    }

    const nearness::closest_point_query& nearest_;
    const cell_grid& grid_;
    double distance_;
    bool near_is_behind_;
    const progress_callback& progress_;
    std::vector<lattice_key> corners_{};  ///< ascending
    std::vector<double> heights_{};       ///< of `corners_`
    std::vector<std::array<edge_key, 3>> triangles_{};
};

}  // namespace

mesh level_surface(const prepared_mesh& mesh, const cell_grid& grid, double distance,
                   bool near_is_behind, const progress_callback& progress) {
    return builder(mesh, grid, distance, near_is_behind, progress).run();
}

}  // namespace treeform::detail::offset
