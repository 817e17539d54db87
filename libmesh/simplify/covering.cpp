#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/simplify/covering.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::simplify {
namespace {

using polygon = std::vector<point3>;

constexpr int most_pieces = 96;  ///< a triangle that needs more is not proven

[[nodiscard]] point3 middle_of(const polygon& piece) {
    point3 sum;
    for (const point3& p : piece) sum = base::plus(sum, p);
    return base::scaled(sum, 1.0 / static_cast<double>(piece.size()));
}

/// What is behind a plane, and what is in front of it. Points in the plane belong to both.
[[nodiscard]] std::array<polygon, 2> halves_of(const polygon& piece, const point3& origin,
                                               const point3& normal) {
    std::array<polygon, 2> halves;
    std::array<bool, 2> strictly{};
    const auto height = [&](const point3& p) { return base::dot(base::minus(p, origin), normal); };
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const point3 &p = piece[i], &q = piece[(i + 1) % piece.size()];
        const double a = height(p), b = height(q);
        for (const std::size_t side : {0U, 1U}) {
            if (side == 0 ? a <= 0.0 : a >= 0.0) halves[side].push_back(p);
            strictly[side] = strictly[side] || (side == 0 ? a < 0.0 : a > 0.0);
        }
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
            const point3 cut = base::plus(p, base::scaled(base::minus(q, p), a / (a - b)));
            for (polygon& half : halves) half.push_back(cut);
        }
    }
    for (const std::size_t side : {0U, 1U})
        if (!strictly[side] && strictly[1 - side]) halves[side].clear();
    return halves;
}

/// Two parts, across the longest edge.
[[nodiscard]] std::array<polygon, 2> bisected(const polygon& piece) {
    std::size_t longest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const point3 way = base::minus(piece[(i + 1) % piece.size()], piece[i]);
        if (base::dot(way, way) > most) most = base::dot(way, way), longest = i;
    }
    const point3 &p = piece[longest], &q = piece[(longest + 1) % piece.size()];
    return halves_of(piece, base::scaled(base::plus(p, q), 0.5), base::minus(q, p));
}

/// Whether a triangle may be within the distance of a piece: their boxes are, along each axis.
[[nodiscard]] bool may_be_near(const triangle3& t, const polygon& piece, double distance) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = piece[0][axis], high = low;
        for (const point3& p : piece) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
        const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (least - high > distance || low - most > distance) return false;
    }
    return true;
}

}  // namespace

covering cover(const triangle3& t, std::span<const triangle3> by, double distance) {
    covering result;
    std::vector<polygon> left{{t[0], t[1], t[2]}};
    std::vector<std::size_t> near;
    double worst = 0.0;
    for (int pieces = 0; !left.empty(); ++pieces) {
        if (pieces >= most_pieces) return {};
        const polygon piece = std::move(left.back());
        left.pop_back();
        std::vector<double> nearest(piece.size(), std::numeric_limits<double>::infinity());
        double best = nearest[0];
        std::size_t whole = 0;
        near.clear();
        for (std::size_t i = 0; i < by.size(); ++i) {
            if (!may_be_near(by[i], piece, distance)) continue;
            near.push_back(i);
            double furthest = 0.0;
            for (std::size_t k = 0; k < piece.size(); ++k) {
                const double d = closest_point(by[i], piece[k]).squared_distance;
                nearest[k] = std::min(nearest[k], d);
                furthest = std::max(furthest, d);
            }
            if (furthest < best) best = furthest, whole = i;
        }
        if (best <= distance * distance) {
            worst = std::max(worst, best);
            result.used.push_back(static_cast<std::uint32_t>(whole));
            continue;
        }
        if (*std::ranges::max_element(nearest) > distance * distance) return {};
        const point3 middle = middle_of(piece);
        const triangle3& at = by[*std::ranges::min_element(near, {}, [&](std::size_t i) {
            return closest_point(by[i], middle).squared_distance;
        })];
        const point3 normal = base::cross(base::minus(at[1], at[0]), base::minus(at[2], at[0]));
        polygon inside = piece;
        bool is_cut = false;
        for (std::size_t i = 0; i < 3 && !inside.empty(); ++i) {
            auto parts =
                halves_of(inside, at[i], base::cross(base::minus(at[(i + 1) % 3], at[i]), normal));
            is_cut = is_cut || (!parts[0].empty() && !parts[1].empty() && parts[0] != parts[1]);
            if (parts[0] == parts[1]) continue;
            if (!parts[1].empty()) left.push_back(std::move(parts[1]));
            inside = std::move(parts[0]);
        }
        if (is_cut) {
            if (!inside.empty()) left.push_back(std::move(inside));
            continue;
        }
        if (inside.empty()) left.pop_back();  // all of it, outside
        auto parts = bisected(piece);
        for (polygon& part : parts)
            if (!part.empty()) left.push_back(std::move(part));
    }
    std::ranges::sort(result.used);
    result.used.erase(std::unique(result.used.begin(), result.used.end()), result.used.end());
    result.proven = true;
    result.at_most = std::sqrt(worst);
    return result;
}

}  // namespace treeform::detail::simplify
