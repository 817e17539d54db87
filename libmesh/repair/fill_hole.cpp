#include <libmesh/base/stars.hpp>
#include <libmesh/repair/fill_hole.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform::detail::repair {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_for_least_area = 200;

/// By which the rim is scaled before areas are compared: a power of two, and 1 but where products
/// of coordinates would not be doubles, so that which hole is filled how does not depend on the
/// unit.
double scale_of(std::span<const point3> points, const std::vector<std::uint32_t>& rim) {
    constexpr int most = 400;
    double largest = 0.0;
    for (const std::uint32_t p : rim)
        for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(points[p][k]));
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::abs(exponent) <= most ? 1.0 : std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
}

double area(const point3& a, const point3& b, const point3& c, double scale) {
    const auto edge = [scale](const point3& from, const point3& to) {
        return point3{to.x * scale - from.x * scale, to.y * scale - from.y * scale,
                      to.z * scale - from.z * scale};
    };
    const point3 u = edge(a, b), v = edge(a, c);
    return 0.5 * std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
}

/// The triangulation of the least total area, by that of all its parts.
class least_area {
  public:
    least_area(std::span<const point3> points, const std::vector<std::uint32_t>& rim,
               const directed_edges& edges)
        : points_(points),
          rim_(rim),
          size_(rim.size()),
          areas_(size_ * size_, infinity),
          middles_(size_ * size_, 0) {
        const double scale = scale_of(points, rim);
        for (std::size_t i = 0; i + 1 < size_; ++i) areas_[i * size_ + i + 1] = 0.0;
        for (std::size_t gap = 2; gap < size_; ++gap)
            for (std::size_t i = 0; i + gap < size_; ++i) {
                const std::size_t j = i + gap;
                const bool is_rim = gap + 1 == size_;
                if (!is_rim && (edges.has(rim[i], rim[j]) || edges.has(rim[j], rim[i]))) continue;
                for (std::size_t m = i + 1; m < j; ++m) {
                    const double sum = areas_[i * size_ + m] + areas_[m * size_ + j] +
                                       area(points[rim[i]], points[rim[m]], points[rim[j]], scale);
                    if (sum >= areas_[i * size_ + j]) continue;
                    areas_[i * size_ + j] = sum;
                    middles_[i * size_ + j] = m;
                }
            }
    }

    [[nodiscard]] std::vector<face> faces() const {
        std::vector<face> found;
        if (!(areas_[size_ - 1] < infinity)) return found;
        std::vector<std::array<std::size_t, 2>> open{{0, size_ - 1}};
        while (!open.empty()) {
            const auto [i, j] = open.back();
            open.pop_back();
            if (j == i + 1) continue;
            const std::size_t m = middles_[i * size_ + j];
            found.push_back({rim_[i], rim_[m], rim_[j]});
            open.push_back({i, m});
            open.push_back({m, j});
        }
        return found;
    }

  private:
    std::span<const point3> points_;
    const std::vector<std::uint32_t>& rim_;
    std::size_t size_;
    std::vector<double> areas_;         ///< [i][j] of the part of the rim from i to j
    std::vector<std::size_t> middles_;  ///< [i][j] third corner of the triangle at i and j
};

/// Cuts off the smallest triangle at a corner, again and again.
std::vector<face> cut_corners(std::span<const point3> points, std::vector<std::uint32_t> rim,
                              const directed_edges& edges) {
    std::vector<face> found;
    const double scale = scale_of(points, rim);
    while (rim.size() > 3) {
        const std::size_t n = rim.size();
        std::size_t best = n;
        double least = infinity;
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t a = rim[(i + n - 1) % n], b = rim[i], c = rim[(i + 1) % n];
            if (edges.has(a, c) || edges.has(c, a)) continue;
            const double size = area(points[a], points[b], points[c], scale);
            if (size >= least) continue;
            least = size;
            best = i;
        }
        if (best == n) return {};
        found.push_back({rim[(best + n - 1) % n], rim[best], rim[(best + 1) % n]});
        rim.erase(rim.begin() + static_cast<std::ptrdiff_t>(best));
    }
    found.push_back({rim[0], rim[1], rim[2]});
    return found;
}

}  // namespace

directed_edges::directed_edges(std::span<const face> faces) {
    edges_.reserve(3 * faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            edges_.push_back({{faces[f][i], faces[f][(i + 1) % 3]}, f});
    std::sort(edges_.begin(), edges_.end(), [](const edge& a, const edge& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
    });
}

std::uint32_t directed_edges::face_along(std::uint32_t u, std::uint32_t v,
                                         std::uint32_t from) const {
    const std::array<std::uint32_t, 2> ends{u, v};
    const auto at =
        std::lower_bound(edges_.begin(), edges_.end(), ends,
                         [from](const edge& e, const std::array<std::uint32_t, 2>& key) {
                             return e.ends != key ? e.ends < key : e.face < from;
                         });
    return at != edges_.end() && at->ends == ends ? at->face : none;
}

bool directed_edges::has(std::uint32_t u, std::uint32_t v) const {
    return face_along(u, v) != none;
}

std::vector<std::vector<std::uint32_t>> find_rims(std::span<const face> faces,
                                                  const directed_edges& edges) {
    // A hole runs from v to u where a face runs from u to v and none from v to u.
    struct rim_edge {
        std::uint32_t from, to;
        bool used = false;
    };
    std::vector<rim_edge> rim_edges;
    for (const face& f : faces)
        for (std::size_t i = 0; i < 3; ++i)
            if (!edges.has(f[(i + 1) % 3], f[i])) rim_edges.push_back({f[(i + 1) % 3], f[i]});
    std::sort(rim_edges.begin(), rim_edges.end(), [](const rim_edge& a, const rim_edge& b) {
        return a.from != b.from ? a.from < b.from : a.to < b.to;
    });
    const auto leaving = [&](std::uint32_t from, std::uint32_t to) -> rim_edge* {
        const auto at = std::lower_bound(rim_edges.begin(), rim_edges.end(), std::array{from, to},
                                         [](const rim_edge& e, const auto& key) {
                                             return std::array{e.from, e.to} < key;
                                         });
        return at != rim_edges.end() && at->from == from && at->to == to ? &*at : nullptr;
    };
    /// After the edge from v to u, the hole goes on along the first open edge around u.
    const auto next = [&](const rim_edge& e) -> rim_edge* {
        std::uint32_t toward = e.from;
        for (std::size_t steps = 0; steps <= faces.size(); ++steps) {
            const std::uint32_t f = edges.face_along(e.to, toward);
            if (f == directed_edges::none) return nullptr;
            const face& c = faces[f];
            const std::size_t i = c[0] == e.to ? 0 : c[1] == e.to ? 1 : 2;
            toward = c[(i + 2) % 3];
            if (!edges.has(e.to, toward)) return leaving(e.to, toward);
        }
        return nullptr;
    };
    std::vector<std::vector<std::uint32_t>> rims;
    for (rim_edge& start : rim_edges) {
        if (start.used) continue;
        std::vector<std::uint32_t> way;
        rim_edge* e = &start;
        while (e != nullptr && !e->used) {
            e->used = true;
            // Back at a point of the way: what lies between is a rim of its own.
            const auto seen = std::find(way.begin(), way.end(), e->from);
            if (seen != way.end()) {
                if (way.end() - seen > 2) rims.emplace_back(seen, way.end());
                way.erase(seen, way.end());
            }
            way.push_back(e->from);
            e = next(*e);
        }
        if (e == &start && way.size() > 2) rims.push_back(std::move(way));
    }
    return rims;
}

std::vector<face> fill(std::span<const point3> points, const std::vector<std::uint32_t>& rim,
                       const directed_edges& edges) {
    if (rim.size() == 3) return {{rim[0], rim[1], rim[2]}};
    if (rim.size() <= most_for_least_area) return least_area(points, rim, edges).faces();
    return cut_corners(points, rim, edges);
}

}  // namespace treeform::detail::repair
