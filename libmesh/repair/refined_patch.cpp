#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/refined_patch.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace treeform::detail::repair {
namespace {

constexpr std::size_t most_refined_points = 100'000;
constexpr int most_refinements = 12;
constexpr int most_swaps = 30;  // of each edge, about

double edge_length(const point3& a, const point3& b) {
    const point3 d = base::minus(a, b);
    return std::sqrt(base::dot(d, d));
}

class refiner {
  public:
    refiner(working_mesh& mesh, const open_rim& rim, const std::vector<face>& filling,
            const directed_edges& edges)
        : mesh_(mesh), edges_(edges), faces_(filling), beyond_(filling.size()) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> along;
        for (std::uint32_t t = 0; t < faces_.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) along[{at(t, i), at(t, i + 1)}] = t;
        for (std::uint32_t t = 0; t < faces_.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const auto other = along.find({at(t, i + 1), at(t, i)});
                beyond_[t][i] = other == along.end() ? none : other->second;
                inner_.insert(std::minmax(at(t, i), at(t, i + 1)));
            }
        const std::size_t n = rim.points.size();
        for (std::size_t i = 0; i < n; ++i) {
            const point3& p = mesh.points[rim.points[i]];
            size_[rim.points[i]] = (edge_length(p, mesh.points[rim.points[(i + 1) % n]]) +
                                    edge_length(p, mesh.points[rim.points[(i + n - 1) % n]])) /
                                   2.0;
        }
    }

    std::vector<face> run() {
        relax();
        for (int round = 0; round < most_refinements && cut(); ++round) relax();
        return std::move(faces_);
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    [[nodiscard]] std::uint32_t at(std::uint32_t t, std::size_t i) const {
        return faces_[t][i % 3];
    }
    [[nodiscard]] const point3& point(std::uint32_t p) const { return mesh_.points[p]; }

    /// Whether a triangle was cut in three.
    bool cut() {
        bool any = false;
        for (std::uint32_t t = 0, count = static_cast<std::uint32_t>(faces_.size()); t < count;
             ++t) {
            if (size_.size() >= most_refined_points) break;
            const auto [a, b, c] = base::triangle_of(mesh_.points, faces_[t]);
            const point3 middle = base::scaled(base::plus(base::plus(a, b), c), 1.0 / 3.0);
            double size = 0.0;
            for (const std::uint32_t p : faces_[t]) size += size_.at(p) / 3.0;
            const bool is_large = std::ranges::all_of(faces_[t], [&](std::uint32_t p) {
                const double away = std::sqrt(2.0) * edge_length(middle, point(p));
                return away > size && away > size_.at(p);
            });
            if (!is_large || collinear(a, b, middle) || collinear(b, c, middle) ||
                collinear(c, a, middle))
                continue;
            cut_at(t, middle, size);
            any = true;
        }
        return any;
    }

    void cut_at(std::uint32_t t, const point3& middle, double size) {
        const auto m = static_cast<std::uint32_t>(mesh_.points.size());
        mesh_.points.push_back(middle);
        size_[m] = size;
        const auto [a, b, c] = faces_[t];
        const auto [past_ab, past_bc, past_ca] = beyond_[t];
        const auto second = static_cast<std::uint32_t>(faces_.size());
        const std::uint32_t third = second + 1;
        faces_[t] = {a, b, m};
        faces_.insert(faces_.end(), {{b, c, m}, {c, a, m}});
        beyond_[t] = {past_ab, second, third};
        beyond_.push_back({past_bc, third, t});
        beyond_.push_back({past_ca, t, second});
        link(past_bc, t, second);
        link(past_ca, t, third);
        for (const std::uint32_t p : {a, b, c}) inner_.insert({p, m});
    }

    /// What was beyond an edge of `t` is now beyond one of `u`.
    void link(std::uint32_t t, std::uint32_t before, std::uint32_t after) {
        if (t != none) std::ranges::replace(beyond_[t], before, after);
    }

    void relax() {
        bool any = true;
        for (int round = 0; any && round < most_swaps; ++round) {
            any = false;
            for (std::uint32_t t = 0; t < faces_.size(); ++t)
                for (std::size_t i = 0; i < 3; ++i) any |= try_to_swap(t, i);
        }
    }

    /// Of the angles at r and s above an edge: negative where they add up to more than 180 degrees.
    [[nodiscard]] double flatness(std::uint32_t p, std::uint32_t q, std::uint32_t r,
                                  std::uint32_t s) const {
        const auto sides = [&](std::uint32_t apex) {
            return std::pair(base::minus(point(p), point(apex)),
                             base::minus(point(q), point(apex)));
        };
        const auto [rp, rq] = sides(r);
        const auto [sp, sq] = sides(s);
        const point3 at_r = base::cross(rp, rq), at_s = base::cross(sp, sq);
        const double sine_r = std::sqrt(base::dot(at_r, at_r));
        const double sine_s = std::sqrt(base::dot(at_s, at_s));
        return base::dot(rp, rq) * sine_s + base::dot(sp, sq) * sine_r + 1e-9 * sine_r * sine_s;
    }

    bool try_to_swap(std::uint32_t t, std::size_t i) {
        const std::uint32_t u = beyond_[t][i];
        if (u == none) return false;
        const std::uint32_t p = at(t, i), q = at(t, i + 1), r = at(t, i + 2);
        const std::size_t j = faces_[u][0] == q ? 0 : faces_[u][1] == q ? 1 : 2;
        const std::uint32_t s = at(u, j + 2);
        if (r == s || !(flatness(p, q, r, s) < 0.0)) return false;
        if (inner_.contains(std::minmax(r, s)) || edges_.has(r, s) || edges_.has(s, r))
            return false;
        if (collinear(point(r), point(p), point(s)) || collinear(point(s), point(q), point(r)))
            return false;
        const std::uint32_t past_rp = beyond_[t][(i + 2) % 3], past_qr = beyond_[t][(i + 1) % 3];
        const std::uint32_t past_ps = beyond_[u][(j + 1) % 3], past_sq = beyond_[u][(j + 2) % 3];
        faces_[t] = {r, p, s};
        faces_[u] = {s, q, r};
        beyond_[t] = {past_rp, past_ps, u};
        beyond_[u] = {past_sq, past_qr, t};
        link(past_ps, u, t);
        link(past_qr, t, u);
        inner_.erase(std::minmax(p, q));
        inner_.insert(std::minmax(r, s));
        return true;
    }

    working_mesh& mesh_;
    const directed_edges& edges_;
    std::vector<face> faces_;
    std::vector<std::array<std::uint32_t, 3>> beyond_;  ///< each edge
    std::set<std::pair<std::uint32_t, std::uint32_t>> inner_{};
    std::map<std::uint32_t, double> size_{};  ///< of edges at each point
};

}  // namespace

std::vector<face> refined_patch(working_mesh& mesh, const open_rim& rim,
                                const std::vector<face>& filling, const directed_edges& edges) {
    return refiner(mesh, rim, filling, edges).run();
}

}  // namespace treeform::detail::repair
