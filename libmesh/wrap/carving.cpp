#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/wrap/balls.hpp>
#include <libmesh/wrap/carving.hpp>

#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace treeform::detail::wrap {
namespace {

/// A face between what is outside and what is not yet.
struct gate {
    double squared_radius;  ///< of a ball that passes
    std::uint32_t inner;
    std::uint32_t births;  ///< of the inner tetrahedron, to know whether it is still there
    std::uint8_t face;

    /// The widest first.
    friend bool operator<(const gate& a, const gate& b) {
        return std::tuple(a.squared_radius, b.inner, b.births, b.face) <
               std::tuple(b.squared_radius, a.inner, a.births, a.face);
    }
};

class carving {
  public:
    carving(const offset_surface& mesh, const box3& around, const carving_options& options)
        : mesh_(mesh),
          options_(options),
          around_(around),
          space_{tetrahedralization(around), std::vector<std::uint8_t>(6, 0)} {}

    bool run(function_ref<bool(std::size_t done, std::size_t waiting)> stop) {
        for (std::uint32_t t = 0; t < 6; ++t) open_gates_of(t);
        for (std::size_t done = 0; !gates_.empty(); ++done) {
            constexpr std::size_t often = 256;
            if (done % often == 0 && stop(done, gates_.size())) return false;
            const gate next = gates_.top();
            gates_.pop();
            if (is_gate(next)) pass(next);
        }
        return true;
    }

    [[nodiscard]] carved_space take() && { return std::move(space_); }

  private:
    [[nodiscard]] bool is_outside(std::uint32_t t) const {
        return t == tetrahedralization::none || space_.is_outside[t] != 0;
    }
    [[nodiscard]] bool is_gate(const gate& g) const {
        return space_.cells.births(g.inner) == g.births && !is_outside(g.inner) &&
               is_outside(space_.cells[g.inner].neighbors[g.face]);
    }
    [[nodiscard]] std::array<point3, 3> corners_of(std::uint32_t t, std::size_t i) const {
        const auto [a, b, c] = space_.cells.face(t, i);
        const std::vector<point3>& p = space_.cells.points();
        return {p[a], p[b], p[c]};
    }

    /// Beyond the box there is nothing, so a center there is as good as any.
    [[nodiscard]] std::optional<ball> ball_outside(std::uint32_t inner, std::size_t i) const {
        const std::uint32_t outer = space_.cells[inner].neighbors[i];
        if (outer != tetrahedralization::none) return ball_of(space_.cells.corners(outer));
        const auto [a, b, c] = corners_of(inner, i);
        const point3 normal = base::cross(base::minus(c, a), base::minus(b, a));
        const point3 diagonal = base::minus(around_.max, around_.min);
        const double far = std::sqrt(base::dot(diagonal, diagonal) / base::dot(normal, normal));
        return ball{base::plus(a, base::scaled(normal, far)),
                    std::numeric_limits<double>::infinity()};
    }

    void open_gate(std::uint32_t inner, std::size_t i) {
        const double squared = least_squared_radius(corners_of(inner, i), ball_outside(inner, i),
                                                    ball_of(space_.cells.corners(inner)));
        if (squared >= options_.size * options_.size)
            gates_.push({squared, inner, space_.cells.births(inner), static_cast<std::uint8_t>(i)});
    }
    void open_gates_of(std::uint32_t inner) {
        for (std::size_t i = 0; i < 4; ++i)
            if (is_outside(space_.cells[inner].neighbors[i])) open_gate(inner, i);
    }

    /// The part of a segment in the box: nothing is near beyond.
    [[nodiscard]] std::optional<std::array<point3, 2>> clipped(const point3& from,
                                                               const point3& to) const {
        double begin = 0.0, end = 1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double way = to[k] - from[k];
            const double low = around_.min[k] - from[k], high = around_.max[k] - from[k];
            if (way == 0.0) {
                if (low > 0.0 || high < 0.0) return std::nullopt;
                continue;
            }
            begin = std::max(begin, std::min(low / way, high / way));
            end = std::min(end, std::max(low / way, high / way));
        }
        if (!(begin < end)) return std::nullopt;
        const point3 way = base::minus(to, from);
        return std::array{base::plus(from, base::scaled(way, begin)),
                          base::plus(from, base::scaled(way, end))};
    }

    void pass(const gate& g) {
        const std::optional<ball> inner = ball_of(space_.cells.corners(g.inner));
        const std::optional<ball> outer = ball_outside(g.inner, g.face);
        if (inner && outer)
            if (const auto way = clipped(outer->center, inner->center))
                if (const auto hit = mesh_.first_on((*way)[0], (*way)[1]))
                    if (insert(*hit, g)) return;
        if (!mesh_.meets(space_.cells.corners(g.inner))) {
            take_away(g.inner);
            return;
        }
        // Where a tetrahedron is flat, its center is anywhere, and may lead to where a corner is.
        if (inner && insert_next_to(inner->center, g)) return;
        insert_next_to(middle(g.inner), g);
    }

    [[nodiscard]] point3 middle(std::uint32_t t) const {
        const auto [a, b, c, d] = space_.cells.corners(t);
        return base::scaled(base::plus(base::plus(a, b), base::plus(c, d)), 0.25);
    }

    bool insert_next_to(const point3& p, const gate& through) {
        const std::optional<point3> at = mesh_.next_to(p);
        return at && insert(*at, through);
    }

    bool insert(point3 p, const gate& through) {
        if (options_.precision == precision::float32)
            p = {base::nearest_float(p.x), base::nearest_float(p.y), base::nearest_float(p.z)};
        // A new corner is about as far from all others as the offset at least; a quarter of it
        // leaves room for what is rounded, and bounds the number of corners.
        if (!space_.cells.insert(p, through.inner, 0.25 * options_.offset)) return false;
        space_.is_outside.resize(space_.cells.size());
        for (const std::uint32_t t : space_.cells.made()) space_.is_outside[t] = 0;
        for (const std::uint32_t t : space_.cells.made()) open_gates_of(t);
        if (is_gate(through)) open_gate(through.inner, through.face);
        return true;
    }

    void take_away(std::uint32_t t) {
        space_.is_outside[t] = 1;
        for (const std::uint32_t next : space_.cells[t].neighbors) {
            if (is_outside(next)) continue;
            for (std::size_t i = 0; i < 4; ++i)
                if (space_.cells[next].neighbors[i] == t) open_gate(next, i);
        }
    }

    const offset_surface& mesh_;
    const carving_options& options_;
    box3 around_;
    carved_space space_;
    std::priority_queue<gate> gates_{};
};

}  // namespace

std::optional<carved_space> carve(const offset_surface& mesh, const box3& around,
                                  const carving_options& options,
                                  function_ref<bool(std::size_t done, std::size_t waiting)> stop) {
    carving work(mesh, around, options);
    if (!work.run(stop)) return std::nullopt;
    return std::move(work).take();
}

}  // namespace treeform::detail::wrap
