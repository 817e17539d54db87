#include <libmesh/base/stars.hpp>
#include <libmesh/round/face_pieces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace treeform::detail::round {

face_pieces::face_pieces(const face& whole, std::span<const point3> points)
    : face_pieces(std::vector<face>{whole}, points) {}

face_pieces::face_pieces(std::vector<face> faces, std::span<const point3> points)
    : points_(points), origin_(points[faces[0][0]]), all_(std::move(faces)) {
    point3 normal;
    for (const auto& [i, j, k] : all_)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
            const point3 &a = points[i], &b = points[j], &c = points[k];
            normal[axis] += (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
        }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    axes_ = {(axis + 1) % 3, (axis + 2) % 3};
    if (normal[axis] < 0.0) std::swap(axes_[0], axes_[1]);
}

face_pieces::flat_point face_pieces::flat(std::uint32_t p) const {
    return {points_[p][axes_[0]] - origin_[axes_[0]], points_[p][axes_[1]] - origin_[axes_[1]]};
}

double face_pieces::area(const flat_point& p, const flat_point& q, const flat_point& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

double face_pieces::area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return area(flat(a), flat(b), flat(c));
}

double face_pieces::depth(const face& f, const flat_point& p) const {
    const flat_point a = flat(f[0]), b = flat(f[1]), c = flat(f[2]);
    const double x = area(p, b, c), y = area(a, p, c), z = area(a, b, p);
    const double sum = std::abs(x) + std::abs(y) + std::abs(z);
    return sum > 0.0 ? std::min({x, y, z}) / sum : -1.0;
}

bool face_pieces::in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                            std::uint32_t d) const {
    const flat_point o = flat(d), p = flat(a), q = flat(b), r = flat(c);
    const double px = p.x - o.x, py = p.y - o.y, qx = q.x - o.x, qy = q.y - o.y, rx = r.x - o.x,
                 ry = r.y - o.y;
    const double pp = px * px + py * py, qq = qx * qx + qy * qy, rr = rx * rx + ry * ry;
    const double x = pp * (qx * ry - qy * rx), y = qq * (px * ry - py * rx),
                 z = rr * (px * qy - py * qx);
    // Beyond rounding, or flips would go round in circles.
    return x - y + z > 0x1p-46 * (std::abs(x) + std::abs(y) + std::abs(z));
}

void face_pieces::split_at(std::uint32_t a, std::uint32_t b, std::uint32_t p) {
    for (face& f : all_)
        for (std::size_t k = 0; k < 3; ++k) {
            if (f[k] != a || f[(k + 1) % 3] != b) continue;
            const std::uint32_t opposite = f[(k + 2) % 3];
            f = {a, p, opposite};
            all_.push_back({p, b, opposite});
            return;
        }
}

void face_pieces::split_edge(std::uint32_t a, std::uint32_t b,
                             std::span<const std::uint32_t> inner) {
    for (const std::uint32_t p : inner) {
        split_at(a, b, p);
        a = p;
    }
}

void face_pieces::split_inside(std::uint32_t p) {
    std::size_t best = all_.size();
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const auto [a, b, c] = all_[i];
        if (!base::has_three_corners(all_[i])) continue;
        if (p == a || p == b || p == c) return;
        const double least = depth(all_[i], flat(p));
        if (least > most) {
            most = least;
            best = i;
        }
    }
    if (best == all_.size()) return;
    const auto [a, b, c] = all_[best];
    all_[best] = {a, b, p};
    all_.push_back({b, c, p});
    all_.push_back({c, a, p});
}

/// Its volume over the area of its largest face: the least of its heights, between which the
/// surfaces by either diagonal lie.
double face_pieces::thickness(const std::array<std::uint32_t, 4>& corners) const {
    const auto minus = [](const point3& p, const point3& q) {
        return point3{p.x - q.x, p.y - q.y, p.z - q.z};
    };
    const auto cross = [](const point3& u, const point3& v) {
        return point3{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    };
    double largest = 0.0, volume = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const point3& at = points_[corners[(k + 1) % 4]];
        const point3 normal = cross(minus(points_[corners[(k + 2) % 4]], at),
                                    minus(points_[corners[(k + 3) % 4]], at));
        const double size = std::hypot(normal.x, normal.y, normal.z);
        if (!(size > largest)) continue;
        largest = size;
        const point3 to = minus(points_[corners[k]], at);
        volume = std::abs(normal.x * to.x + normal.y * to.y + normal.z * to.z);
    }
    return largest > 0.0 ? volume / largest : 0.0;
}

face_pieces::flips face_pieces::flip_once(std::span<const std::array<std::uint32_t, 2>> kept,
                                          double most) {
    struct half_edge {
        std::uint32_t a, b;  // the lower end first
        std::uint32_t piece;
        bool operator<(const half_edge& other) const {
            return std::array{a, b, piece} < std::array{other.a, other.b, other.piece};
        }
    };
    std::vector<half_edge> edges;
    for (std::uint32_t i = 0; i < all_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(all_[i][k], all_[i][(k + 1) % 3]);
            edges.push_back({a, b, i});
        }
    std::sort(edges.begin(), edges.end());
    std::vector<bool> changed(all_.size(), false);
    flips done;
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
        const half_edge &one = edges[e], &two = edges[e + 1];
        const auto same = [&](const half_edge& x) { return x.a == one.a && x.b == one.b; };
        // A piece that repeats a corner is on either side of its edge.
        if (!same(two) || one.piece == two.piece || (e > 0 && same(edges[e - 1])) ||
            (e + 2 < edges.size() && same(edges[e + 2])) || changed[one.piece] ||
            changed[two.piece] ||
            std::binary_search(kept.begin(), kept.end(), std::array{one.a, one.b}))
            continue;
        face &f = all_[one.piece], &g = all_[two.piece];
        std::size_t i = 0, j = 0;
        while (f[i] == one.a || f[i] == one.b) ++i;
        while (g[j] == one.a || g[j] == one.b) ++j;
        const std::uint32_t c = f[i], a = f[(i + 1) % 3], b = f[(i + 2) % 3], d = g[j];
        if (g[(j + 1) % 3] != b || g[(j + 2) % 3] != a || c == d) continue;
        if (!(area(a, d, c) > 0.0) || !(area(d, b, c) > 0.0)) continue;
        const bool flat = !(area(a, b, c) > 0.0) || !(area(b, a, d) > 0.0);
        if (!flat && !in_circle(a, b, c, d)) continue;
        const double thick = thickness({a, b, c, d});
        if (!(thick <= most)) continue;
        done.moved = std::max(done.moved, thick);
        f = {a, d, c};
        g = {d, b, c};
        changed[one.piece] = changed[two.piece] = true;
        done.any = true;
    }
    return done;
}

double face_pieces::flip(std::span<const std::array<std::uint32_t, 2>> kept, double most) {
    constexpr int most_passes = 50;
    double moved = 0.0;
    for (int pass = 0; pass < most_passes; ++pass) {
        const flips done = flip_once(kept, most);
        moved += done.moved;  // what has moved may move again
        if (!done.any) break;
    }
    return moved;
}

std::vector<std::size_t> face_pieces::lying_in(std::span<const face> before) const {
    std::vector<std::size_t> found(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
        found[i] = std::min(i, before.size() - 1);
        if (all_[i] == before[found[i]]) continue;
        const flat_point a = flat(all_[i][0]), b = flat(all_[i][1]), c = flat(all_[i][2]);
        const flat_point middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < before.size(); ++k) {
            const double least = depth(before[k], middle);
            if (!(least > most)) continue;
            most = least;
            found[i] = k;
        }
    }
    return found;
}

}  // namespace treeform::detail::round
