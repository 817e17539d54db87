#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/simplify/covering.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace treeform::detail::simplify {
namespace {

constexpr int most_pieces = 200;  ///< a triangle that needs more is not proven

}  // namespace

/// Points in the plane belong to both halves; a half of such points only is empty. Signs may be
/// wrong, as long as there is one cut: halves cover the piece.
covering::halves covering::halves_of(const piece& of, const point3& at, const point3& normal) {
    std::array<double, 12> height{};
    double lowest = 0.0, highest = 0.0;
    for (std::size_t i = 0; i < of.count; ++i) {
        height[i] = base::dot(base::minus(of.corners[i], at), normal);
        lowest = std::min(lowest, height[i]);
        highest = std::max(highest, height[i]);
    }
    std::size_t changes = 0;
    for (std::size_t i = 0; i < of.count; ++i)
        if ((height[i] < 0.0) != (height[i + 1 == of.count ? 0 : i + 1] < 0.0)) ++changes;
    if (!(highest > 0.0) || changes > 2) return {of, {}};
    if (!(lowest < 0.0)) return {{}, of};
    halves parts;
    for (std::size_t i = 0; i < of.count; ++i) {
        const std::size_t next = i + 1 == of.count ? 0 : i + 1;
        const point3 &p = of.corners[i], &q = of.corners[next];
        const double a = height[i], b = height[next];
        if (a <= 0.0) parts.behind.corners[parts.behind.count++] = p;
        if (a >= 0.0) parts.before.corners[parts.before.count++] = p;
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
            const point3 cut = base::plus(p, base::scaled(base::minus(q, p), a / (a - b)));
            parts.behind.corners[parts.behind.count++] = cut;
            parts.before.corners[parts.before.count++] = cut;
        }
    }
    for (piece* part : {&parts.behind, &parts.before}) {
        part->cuts = of.cuts + 1;
        part->near_begin = of.near_begin;
        part->near_end = of.near_end;
    }
    return parts;
}

void covering::use_of(std::uint32_t number, double at_most) {
    for (use& known : used_)
        if (known.number == number) {
            known.at_most = std::max(known.at_most, at_most);
            return;
        }
    used_.push_back({number, at_most});
}

/// Cuts along planes through the sides of `at`, upright on it. Whether it is in parts then.
bool covering::cut_along(const piece& whole, const triangle3& at) {
    const point3 normal = base::cross(base::minus(at[1], at[0]), base::minus(at[2], at[0]));
    const std::size_t before = left_.size();
    piece inside = whole;
    for (std::size_t i = 0; i < 3 && inside.count > 0; ++i) {
        const halves parts =
            halves_of(inside, at[i], base::cross(base::minus(at[(i + 1) % 3], at[i]), normal));
        if (parts.before.count > 0) left_.push_back(parts.before);
        inside = parts.behind;
    }
    if (inside.count > 0) left_.push_back(inside);
    if (left_.size() - before > 1) return true;
    left_.resize(before);
    return false;
}

/// Across the longest edge.
void covering::halve(const piece& whole) {
    std::size_t longest = 0;
    double most = -1.0;
    const auto next = [&](std::size_t i) { return i + 1 == whole.count ? 0 : i + 1; };
    for (std::size_t i = 0; i < whole.count; ++i) {
        const point3 way = base::minus(whole.corners[next(i)], whole.corners[i]);
        if (base::dot(way, way) > most) most = base::dot(way, way), longest = i;
    }
    const point3 &p = whole.corners[longest], &q = whole.corners[next(longest)];
    const halves parts = halves_of(whole, base::scaled(base::plus(p, q), 0.5), base::minus(q, p));
    if (parts.behind.count > 0) left_.push_back(parts.behind);
    if (parts.before.count > 0) left_.push_back(parts.before);
}

/// Proves the last piece, or cuts it; false where it cannot be proven.
bool covering::settle(std::span<const target> by, double distance) {
    piece whole = left_.back();
    left_.pop_back();
    const double blur = unit_ * (40.0 + 9.0 * whole.cuts), limit = distance - blur;
    if (!(limit > 0.0) || whole.count + 3 > whole.corners.size()) return false;
    aabb<double, 3> box;
    point3 middle;
    for (std::size_t k = 0; k < whole.count; ++k) {
        box.include(whole.corners[k]);
        middle = base::plus(middle, whole.corners[k]);
    }
    middle = base::scaled(middle, 1.0 / whole.count);
    for (std::size_t axis = 0; axis < 3; ++axis)
        box.min[axis] -= distance, box.max[axis] += distance;
    const auto squared = [&](std::uint32_t i, const point3& p) {
        return geometry::squared_distance(by[i].based, p);
    };
    // Its parts are near no others than it is.
    near_.resize(whole.near_end);
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t n = whole.near_begin; n < whole.near_end; ++n) {
        const std::uint32_t i = near_[n];
        if (!overlaps(by[i].box, box)) continue;
        near_.push_back(i);
        if (squared_distance(by[i].box, middle) >= least) continue;
        if (const double d = squared(i, middle); d < least) least = d, best = i;
    }
    whole.near_begin = whole.near_end;
    whole.near_end = static_cast<std::uint32_t>(near_.size());
    if (!(least <= limit * limit)) return false;
    double furthest = 0.0;
    for (std::uint32_t k = 0; k < whole.count; ++k) {
        const double d = squared(best, whole.corners[k]);
        furthest = std::max(furthest, d);
        if (d > limit * limit &&
            std::none_of(near_.begin() + whole.near_begin, near_.end(), [&](std::uint32_t i) {
                return squared(i, whole.corners[k]) <= limit * limit;
            }))
            return false;
    }
    if (furthest <= limit * limit)
        use_of(best, std::sqrt(furthest) + blur);
    else if (!cut_along(whole, by[best].corners))
        halve(whole);
    return true;
}

bool covering::cover(const triangle3& t, std::span<const target> by, double distance) {
    used_.clear();
    left_.clear();
    near_.clear();
    piece whole;
    std::copy(t.begin(), t.end(), whole.corners.begin());
    whole.count = 3;
    for (std::uint32_t i = 0; i < by.size(); ++i) near_.push_back(i);
    whole.near_end = static_cast<std::uint32_t>(near_.size());
    left_.push_back(whole);
    for (int pieces = 0; !left_.empty(); ++pieces)
        if (pieces >= most_pieces || !settle(by, distance)) return false;
    return true;
}

}  // namespace treeform::detail::simplify
