#include <libmesh/simplify/seen_along.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace treeform::detail::simplify {
namespace {

/// Twice the area of p, q, r in the view.
[[nodiscard]] double turn_of(const point3& p, const point3& q, const point3& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

[[nodiscard]] double sides_error(double extent) { return 0x1p-46 * extent * extent; }

/// A convex polygon; were signs wrong, each of three cuts might still do no more than double it.
struct cut_corners {
    std::array<point3, 24> at;
    std::size_t count = 0;
};

/// What of `from` is to the left of p q, or is right of it by no more than `error`.
[[nodiscard]] cut_corners left_of(const cut_corners& from, const point3& p, const point3& q,
                                  double error) {
    cut_corners kept;
    for (std::size_t i = 0; i < from.count; ++i) {
        const point3 &a = from.at[i], &b = from.at[i + 1 == from.count ? 0 : i + 1];
        const double here = turn_of(p, q, a) + error, next = turn_of(p, q, b) + error;
        if (here >= 0.0) kept.at[kept.count++] = a;
        if ((here < 0.0) != (next < 0.0)) {
            const double share = here / (here - next);
            kept.at[kept.count++] = base::plus(a, base::scaled(base::minus(b, a), share));
        }
    }
    return kept;
}

}  // namespace

view_along::view_along(const point3& direction, const point3& around) : around_(around) {
    along_ = unit_of(direction);
    const bool flat = std::abs(along_.x) < 0.6;
    across_ = unit_of(base::cross(along_, flat ? point3{1.0, 0.0, 0.0} : point3{0.0, 1.0, 0.0}));
    up_ = base::cross(along_, across_);
}

seen_triangle view_along::see(const triangle3& t) const {
    seen_triangle seen;
    for (std::size_t i = 0; i < 3; ++i) {
        const point3 to = base::minus(t[i], around_);
        seen.at[i] = {base::dot(to, across_), base::dot(to, up_), base::dot(to, along_)};
        seen.extent = std::max(seen.extent, base::largest_of(seen.at[i]));
    }
    return seen;
}

bool view_along::faces_eye(const triangle3& t, const seen_triangle& seen) const {
    const point3 normal = normal_of(t);
    const double area = base::dot(normal, along_);
    return area > 0x1p-40 * seen.extent * seen.extent &&
           area * area > 0.04 * base::dot(normal, normal);
}

std::optional<double> gap_between(const seen_triangle& a, const seen_triangle& b) {
    const double extent = std::max(a.extent, b.extent), error = sides_error(extent);
    std::array<bool, 3> cuts{};
    for (std::size_t i = 0; i < 3; ++i) {
        const point3 &p = b.at[i], &q = b.at[(i + 1) % 3];
        int out = 0;
        for (const point3& corner : a.at) out += turn_of(p, q, corner) < -error ? 1 : 0;
        if (out == 3) return std::nullopt;
        cuts[i] = out > 0;
    }
    cut_corners common;
    std::copy(a.at.begin(), a.at.end(), common.at.begin());
    common.count = 3;
    for (std::size_t i = 0; i < 3 && common.count > 0; ++i)
        if (cuts[i]) common = left_of(common, b.at[i], b.at[(i + 1) % 3], error);
    if (common.count == 0) return std::nullopt;
    const double area = turn_of(b.at[0], b.at[1], b.at[2]);
    const double rise_1 = b.at[1].z - b.at[0].z, rise_2 = b.at[2].z - b.at[0].z;
    double gap = 0.0;
    for (std::size_t i = 0; i < common.count; ++i) {
        const point3& at = common.at[i];
        const double rise =
            (turn_of(b.at[0], at, b.at[2]) * rise_1 + turn_of(b.at[0], b.at[1], at) * rise_2) /
            area;
        gap = std::max(gap, std::abs(b.at[0].z + rise - at.z));
    }
    return gap + 0x1p-44 * extent +
           0x1p-45 * extent * extent / area * (std::abs(rise_1) + std::abs(rise_2));
}

bool is_seen_within(const seen_triangle& t, const point3& at) {
    const double error = sides_error(std::max(t.extent, base::largest_of(at)));
    return turn_of(t.at[0], t.at[1], at) > error && turn_of(t.at[1], t.at[2], at) > error &&
           turn_of(t.at[2], t.at[0], at) > error;
}

}  // namespace treeform::detail::simplify
