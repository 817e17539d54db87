#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/triangulate_rim.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

namespace treeform::detail::repair {
namespace {

constexpr double no_way = std::numeric_limits<double>::infinity();
constexpr std::size_t most_at_once = 100;
constexpr double weight_of_edge = 0.1;  // the square of the longest edge, beside the area
constexpr double weight_of_fold = 0.5;

/// In lengths relative to the rim's own, lest squares overflow.
class rim_geometry {
  public:
    rim_geometry(const working_mesh& mesh, const open_rim& rim, const directed_edges& edges)
        : mesh_(mesh), edges_(edges), base_(mesh.points[rim.points[0]]) {
        double extent = 0.0;
        for (const std::uint32_t p : rim.points)
            for (std::size_t k = 0; k < 3; ++k)
                extent = std::max(extent, std::abs(mesh.points[p][k] / 2.0 - base_[k] / 2.0));
        int exponent = 0;
        std::frexp(extent, &exponent);
        exponent_ = -std::clamp(exponent, -1000, 1000);
    }

    /// The normal, as long as twice the area.
    [[nodiscard]] point3 normal(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return base::cross(base::minus(at(b), at(a)), base::minus(at(c), at(a)));
    }
    [[nodiscard]] point3 normal_of(std::uint32_t f) const {
        const auto [a, b, c] = mesh_.faces[f];
        return normal(a, b, c);
    }

    /// None is infinite.
    [[nodiscard]] double cost(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        if (collinear(mesh_.points[a], mesh_.points[b], mesh_.points[c])) return no_way;
        const point3 n = normal(a, b, c);
        const double longest = std::max({square(a, b), square(b, c), square(c, a)});
        return std::sqrt(base::dot(n, n)) / 2.0 + weight_of_edge * longest;
    }

    /// Of two faces with these normals beside the edge from u to v.
    [[nodiscard]] double fold(std::uint32_t u, std::uint32_t v, const point3& m,
                              const point3& n) const {
        const double lengths = std::sqrt(base::dot(m, m)) * std::sqrt(base::dot(n, n));
        if (!(lengths > 0.0)) return 0.0;
        return weight_of_fold * square(u, v) * (1.0 - base::dot(m, n) / lengths);
    }

    [[nodiscard]] bool is_there(std::uint32_t u, std::uint32_t v) const {
        return edges_.has(u, v) || edges_.has(v, u);
    }

  private:
    [[nodiscard]] point3 at(std::uint32_t p) const {
        const point3 d = base::minus(mesh_.points[p], base_);
        return {std::ldexp(d.x, exponent_), std::ldexp(d.y, exponent_), std::ldexp(d.z, exponent_)};
    }
    [[nodiscard]] double square(std::uint32_t a, std::uint32_t b) const {
        const point3 d = base::minus(at(b), at(a));
        return base::dot(d, d);
    }

    const working_mesh& mesh_;
    const directed_edges& edges_;
    point3 base_;
    int exponent_ = 0;
};

/// Points of a rim, and the normal beyond each edge from one to the next.
struct weighted_rim {
    std::vector<std::uint32_t> points{};
    std::vector<point3> normals{};
};

/// The best triangulation, by those of all parts of the rim. A fold is counted with the triangles
/// that are best beyond it.
class best_triangulation {
  public:
    best_triangulation(const rim_geometry& geometry, const weighted_rim& rim)
        : geometry_(geometry),
          rim_(rim),
          size_(rim.points.size()),
          costs_(size_ * size_, no_way),
          middles_(size_ * size_, 0) {
        for (std::size_t i = 0; i + 1 < size_; ++i) costs_[i * size_ + i + 1] = 0.0;
        for (std::size_t gap = 2; gap < size_; ++gap)
            for (std::size_t i = 0; i + gap < size_; ++i) close(i, i + gap);
    }

    void append_to(std::vector<face>& found) const {
        if (!(costs_[size_ - 1] < no_way)) {
            found.clear();
            return;
        }
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, size_ - 1}};
        while (!open.empty()) {
            const auto [i, j] = open.back();
            open.pop_back();
            if (j == i + 1) continue;
            const std::size_t m = middles_[i * size_ + j];
            found.push_back({rim_.points[i], rim_.points[m], rim_.points[j]});
            open.emplace_back(i, m);
            open.emplace_back(m, j);
        }
    }

  private:
    void close(std::size_t i, std::size_t j) {
        const std::uint32_t a = rim_.points[i], c = rim_.points[j];
        const bool is_last = i == 0 && j + 1 == size_;
        if (!is_last && geometry_.is_there(a, c)) return;
        double& least = costs_[i * size_ + j];
        for (std::size_t m = i + 1; m < j; ++m) {
            double sum = costs_[i * size_ + m] + costs_[m * size_ + j];
            if (!(sum < least)) continue;
            const std::uint32_t b = rim_.points[m];
            sum += geometry_.cost(a, b, c);
            if (!(sum < least)) continue;
            const point3 normal = geometry_.normal(a, b, c);
            sum += geometry_.fold(a, b, normal, beyond(i, m)) +
                   geometry_.fold(b, c, normal, beyond(m, j));
            if (is_last) sum += geometry_.fold(a, c, normal, rim_.normals.back());
            if (!(sum < least)) continue;
            least = sum;
            middles_[i * size_ + j] = m;
        }
    }

    [[nodiscard]] point3 beyond(std::size_t i, std::size_t j) const {
        if (j == i + 1) return rim_.normals[i];
        return geometry_.normal(rim_.points[i], rim_.points[middles_[i * size_ + j]],
                                rim_.points[j]);
    }

    const rim_geometry& geometry_;
    const weighted_rim& rim_;
    std::size_t size_;
    std::vector<double> costs_;         ///< [i][j] of the part of the rim from i to j
    std::vector<std::size_t> middles_;  ///< [i][j] third corner of the triangle at i and j
};

/// Cuts corners off a rim, the cheapest first.
class corner_cutter {
  public:
    corner_cutter(const rim_geometry& geometry, weighted_rim& rim)
        : geometry_(geometry), rim_(rim), before_(rim.points.size()), after_(before_.size()) {
        const std::size_t n = before_.size();
        for (std::size_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
        costs_.assign(n, no_way);
        for (std::size_t i = 0; i < n; ++i) look_at(i);
    }

    /// Until so many are left, or no corner can be cut off.
    void run(std::size_t left, std::vector<face>& found) {
        std::vector<std::uint8_t> is_cut(before_.size(), 0);
        for (std::size_t n = before_.size(); n > left && !queue_.empty(); --n) {
            const std::size_t i = queue_.begin()->second;
            const std::size_t h = before_[i], k = after_[i];
            queue_.erase(queue_.begin());
            is_cut[i] = 1;
            found.push_back({rim_.points[h], rim_.points[i], rim_.points[k]});
            rim_.normals[h] = geometry_.normal(rim_.points[h], rim_.points[i], rim_.points[k]);
            after_[h] = k;
            before_[k] = h;
            look_at(h);
            look_at(k);
        }
        weighted_rim rest;
        for (std::size_t i = 0; i < is_cut.size(); ++i) {
            if (is_cut[i] != 0) continue;
            rest.points.push_back(rim_.points[i]);
            rest.normals.push_back(rim_.normals[i]);
        }
        rim_ = std::move(rest);
    }

  private:
    void look_at(std::size_t i) {
        queue_.erase({costs_[i], i});
        costs_[i] = no_way;
        const std::size_t h = before_[i];
        const std::uint32_t a = rim_.points[h], b = rim_.points[i], c = rim_.points[after_[i]];
        if (geometry_.is_there(a, c)) return;
        const double cost = geometry_.cost(a, b, c);
        if (!(cost < no_way)) return;
        const point3 normal = geometry_.normal(a, b, c);
        costs_[i] = cost + geometry_.fold(a, b, normal, rim_.normals[h]) +
                    geometry_.fold(b, c, normal, rim_.normals[i]);
        queue_.emplace(costs_[i], i);
    }

    const rim_geometry& geometry_;
    weighted_rim& rim_;
    std::vector<std::size_t> before_, after_;
    std::vector<double> costs_{};
    std::set<std::pair<double, std::size_t>> queue_{};
};

}  // namespace

std::vector<face> triangulate_rim(const working_mesh& mesh, const open_rim& rim,
                                  const directed_edges& edges) {
    const rim_geometry geometry(mesh, rim, edges);
    weighted_rim rest{rim.points, {}};
    for (const std::uint32_t f : rim.faces) rest.normals.push_back(geometry.normal_of(f));
    std::vector<face> found;
    if (rest.points.size() > most_at_once) corner_cutter(geometry, rest).run(most_at_once, found);
    if (rest.points.size() > most_at_once) return {};
    best_triangulation(geometry, rest).append_to(found);
    return found;
}

}  // namespace treeform::detail::repair
