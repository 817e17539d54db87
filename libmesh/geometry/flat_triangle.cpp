#include <libmesh/geometry/features.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <libmesh/geometry/signs.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace treeform::detail::geometry {
namespace {

/// An integer that orders as the double does, both zeros being one.
std::int64_t ordered_bits(double x) {
    const auto bits = std::bit_cast<std::int64_t>(x);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
}

triangle_feature edge_between(int i, int j) { return edge(next(i) == j ? i : j); }

/// The lowest-numbered edge whose ends are different points.
triangle_feature first_true_edge(const triangle3& t) {
    int i = 0;
    while (equal_points(at(t, i), at(t, next(i)))) ++i;
    return edge(i);
}

/// Corners with the least and the greatest coordinates, of equal ones the first.
std::array<int, 2> extremes(const triangle3& t) {
    std::array<int, 2> found{0, 0};
    for (int i = 1; i < 3; ++i) {
        if (lexicographically_less(at(t, i), at(t, found[0]))) found[0] = i;
        if (lexicographically_less(at(t, found[1]), at(t, i))) found[1] = i;
    }
    return found;
}

}  // namespace

bool lexicographically_less(const point3& p, const point3& q) {
    const std::array keys_of_p{ordered_bits(p.x), ordered_bits(p.y), ordered_bits(p.z)};
    const std::array keys_of_q{ordered_bits(q.x), ordered_bits(q.y), ordered_bits(q.z)};
    return keys_of_p < keys_of_q;
}

flat_triangle flatten(const triangle3& t) {
    const auto [low, high] = extremes(t);
    const point3& from = at(t, low);
    const point3& to = at(t, high);
    flat_triangle flat{};
    if (low == high) {
        flat.is_point = true;
        flat.parts[0] = {from, from, corner(low), corner(low), corner(low)};
        return flat;
    }
    const int middle = 3 - low - high;
    const point3& cut = at(t, middle);
    if (equal_points(cut, from) || equal_points(cut, to)) {
        flat.parts[0] = {from, to, corner(low), corner(high), first_true_edge(t)};
        return flat;
    }
    const triangle_feature whole = edge_between(low, high);
    flat.part_count = 2;
    flat.parts[0] = {from, cut, corner(low), corner(middle),
                     std::min(whole, edge_between(low, middle))};
    flat.parts[1] = {cut, to, corner(middle), corner(high),
                     std::min(whole, edge_between(middle, high))};
    return flat;
}

}  // namespace treeform::detail::geometry
