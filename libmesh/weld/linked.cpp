#include <libmesh/weld/linked.hpp>

#include <algorithm>
#include <cstddef>

namespace treeform::detail::weld {
namespace {

struct box {
    point3 min;
    point3 max;
};

box box_of(const matcher& match, std::span<const std::uint32_t> ids) {
    box result{match.point(ids[0]), match.point(ids[0])};
    for (const std::uint32_t i : ids)
        for (std::size_t k = 0; k < 3; ++k) {
            result.min[k] = std::min(result.min[k], match.point(i)[k]);
            result.max[k] = std::max(result.max[k], match.point(i)[k]);
        }
    return result;
}

/// Whether the nearest points of two boxes are near, then their farthest: they differ as corners
/// of the boxes do, so that nothing is rounded.
bool may_match(const matcher& match, const box& a, const box& b) {
    point3 p{};
    point3 q{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (a.max[k] < b.min[k]) {
            p[k] = a.max[k];
            q[k] = b.min[k];
        } else if (b.max[k] < a.min[k]) {
            p[k] = a.min[k];
            q[k] = b.max[k];
        }
    }
    return match.near(p, q);
}
bool all_near(const matcher& match, const box& a, const box& b) {
    point3 p{};
    point3 q{};
    for (std::size_t k = 0; k < 3; ++k) {
        const bool up = compare_distance({a.max[k], 0, 0}, {b.min[k], 0, 0}, {b.max[k], 0, 0},
                                         {a.min[k], 0, 0}) > 0;
        p[k] = up ? a.max[k] : a.min[k];
        q[k] = up ? b.min[k] : b.max[k];
    }
    return match.near(p, q);
}

bool any_of_all(const matcher& match, std::span<const std::uint32_t> a,
                std::span<const std::uint32_t> b) {
    for (const std::uint32_t i : a)
        for (const std::uint32_t j : b)
            if (match(i, j)) return true;
    return false;
}

std::uint32_t nearest_to(const matcher& match, const point3& p,
                         std::span<const std::uint32_t> ids) {
    return *std::min_element(ids.begin(), ids.end(), [&](std::uint32_t i, std::uint32_t j) {
        return rounded_squared_distance(match.point(i), p) <
               rounded_squared_distance(match.point(j), p);
    });
}

std::size_t longest_axis(const box& of) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (of.max[k] - of.min[k] > of.max[axis] - of.min[axis]) axis = k;
    return axis;
}
double longest_side(const box& of) {
    const std::size_t axis = longest_axis(of);
    return of.max[axis] - of.min[axis];
}

/// Cut across its longest side.
std::size_t halve(const matcher& match, std::span<std::uint32_t> ids, const box& around) {
    const std::size_t axis = longest_axis(around);
    const std::size_t half = ids.size() / 2;
    std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(half), ids.end(),
                     [&](std::uint32_t i, std::uint32_t j) {
                         return match.point(i)[axis] < match.point(j)[axis];
                     });
    return half;
}

bool any_match_of_halves(const matcher& match, std::span<std::uint32_t> a,
                         std::span<std::uint32_t> b) {
    constexpr std::size_t few = 64;
    if (a.size() * b.size() <= few) return any_of_all(match, a, b);
    const box of_a = box_of(match, a);
    const box of_b = box_of(match, b);
    if (!may_match(match, of_a, of_b)) return false;
    if (all_near(match, of_a, of_b)) return match.by_distance() || any_of_all(match, a, b);
    if (b.size() > 1 && (a.size() == 1 || longest_side(of_b) > longest_side(of_a)))
        return any_match_of_halves(match, b, a);
    const std::size_t half = halve(match, a, of_a);
    return any_match_of_halves(match, a.first(half), b) ||
           any_match_of_halves(match, a.subspan(half), b);
}

}  // namespace

bool any_match(const matcher& match, std::span<std::uint32_t> a, std::span<std::uint32_t> b) {
    // Most sets that match do so where they face each other.
    const std::uint32_t i = nearest_to(match, match.point(b[0]), a);
    const std::uint32_t j = nearest_to(match, match.point(i), b);
    return match(nearest_to(match, match.point(j), a), j) || any_match_of_halves(match, a, b);
}

}  // namespace treeform::detail::weld
