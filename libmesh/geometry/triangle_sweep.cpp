#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform {
namespace {

constexpr triangle_feature corner(std::size_t i) { return static_cast<triangle_feature>(i); }
constexpr triangle_feature edge(std::size_t i) { return static_cast<triangle_feature>(3 + i); }
constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

/// The plane with its normal turned so that the motion crosses it forwards.
/// \pre sign is that of normal . d and not 0
cutting_plane forwards(cutting_plane plane, int sign) {
    if (sign < 0) {
        std::swap(plane.u_from, plane.v_from);
        std::swap(plane.u_to, plane.v_to);
    }
    return plane;
}

/// Whether rounded times tell the order of the exact ones, which they are within 2^-40 of where
/// they are not denormal.
bool settled(double time, double other) {
    const double larger = std::max(std::abs(time), std::abs(other));
    return larger > 0x1p-900 && std::abs(time - other) > 0x1p-38 * larger;
}

/// Collects the times at which features meet and keeps the first that is not negative.
class first_of {
  public:
    first_of(const point3& d, predicate_counters* counters) : d_(d), counters_(counters) {}

    /// `plane` is met by `from`, in motion, forwards.
    void offer(feature_pair at, const point3& from, const cutting_plane& plane) {
        const double time = cut_parameter(from, d_, plane);
        if (time < 0.0) return;
        if (time == 0.0 && compare_cut(from, d_, plane, 0.0, counters_) < 0) return;
        const sweep_contact one{at, time, from, plane};
        if (!best || compare(d_, one, *best, counters_) < 0) best = one;
    }

    std::optional<sweep_contact> best;

  private:
    const point3& d_;
    predicate_counters* counters_;
};

/// Signs of ((q - p) x (r - p)) . d for a corner p of one triangle and an edge q, r of the other:
/// on which side of the edge the corner lies, seen along the motion.
struct sides {
    std::array<std::array<int, 3>, 3> of{};  ///< [corner][edge]

    sides(const triangle3& corners, const triangle3& edges, const point3& d,
          predicate_counters* counters) {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                of[i][j] = direction_side(corners[i], edges[j], edges[next(j)], d, counters);
    }

    /// Whether corner i lies in the other triangle, seen along the motion.
    [[nodiscard]] bool inside(std::size_t i, int turn) const {
        return of[i][0] * turn >= 0 && of[i][1] * turn >= 0 && of[i][2] * turn >= 0;
    }
    /// Whether some edge has all corners strictly on its outer side.
    [[nodiscard]] bool apart(int turn) const {
        if (turn == 0) return false;
        for (std::size_t j = 0; j < 3; ++j)
            if (of[0][j] * turn < 0 && of[1][j] * turn < 0 && of[2][j] * turn < 0) return true;
        return false;
    }
    [[nodiscard]] triangle_feature hit(std::size_t i) const {
        for (std::size_t j = 0; j < 3; ++j)
            if (of[i][j] == 0 && of[i][next(j)] == 0) return corner(next(j));
        for (std::size_t j = 0; j < 3; ++j)
            if (of[i][j] == 0) return edge(j);
        return triangle_feature::interior;
    }
};

constexpr bool opposite(int s, int t) { return s * t <= 0 && (s != 0 || t != 0); }

/// Where the motion runs in the plane of both triangles, or a triangle is degenerate: a corner that
/// gets to an edge of the other or to its corner. Times are those of planes that hold the edge and
/// an axis, or two axes.
void offer_flat(const triangle3& a, const triangle3& b, const point3& d, first_of& first,
                predicate_counters* counters) {
    // A vector along an axis, as long as a component of d: the lattice of a call grows by nothing.
    double length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) length = std::max(length, std::abs(d[k]));
    std::array<point3, 3> axis{};
    for (std::size_t k = 0; k < 3; ++k) axis[k][k] = length;
    constexpr point3 origin{};
    const point3 back{-d.x, -d.y, -d.z};

    const auto corner_on_corner = [&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < 3; ++k)
            if (line_side(static_cast<int>(k), a[i], d, b[j], counters) != 0) return;
        for (std::size_t k = 0; k < 3; ++k)
            if (d[k] != 0.0) {
                const cutting_plane plane{b[j], origin, axis[next(k)], origin, axis[next(next(k))]};
                first.offer({corner(i), corner(j)}, a[i], forwards(plane, d[k] > 0.0 ? 1 : -1));
                return;
            }
    };
    // The corner moves along `motion` as seen from the edge q, r, in the plane of both.
    const auto meets = [&](const point3& p, const point3& motion, const point3& q, const point3& r,
                           int& axis_of) {
        if (direction_side(p, q, r, motion, counters) != 0) return 0;
        for (int k = 0; k < 3; ++k) {
            const int to_q = line_side(k, p, motion, q, counters);
            const int to_r = line_side(k, p, motion, r, counters);
            if (to_q == 0 && to_r == 0) continue;
            axis_of = k;
            return opposite(to_q, to_r) ? (to_r - to_q > 0 ? 1 : -1) : 0;
        }
        return 0;
    };
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            corner_on_corner(i, j);
            int k = 0;
            // (d x (r - q))_k > 0 is ((r - q) x e_k) . d > 0.
            if (const int sign = meets(a[i], d, b[j], b[next(j)], k)) {
                const point3& along = axis[static_cast<std::size_t>(k)];
                first.offer({corner(i), edge(j)}, a[i],
                            forwards({b[j], b[j], b[next(j)], origin, along}, sign));
            }
            if (const int sign = meets(b[j], back, a[i], a[next(i)], k)) {
                const point3& along = axis[static_cast<std::size_t>(k)];
                first.offer({edge(i), corner(j)}, a[i],
                            forwards({b[j], a[i], a[next(i)], origin, along}, -sign));
            }
        }
}

}  // namespace

std::optional<sweep_contact> first_contact(const triangle3& a, const triangle3& b, const point3& d,
                                           predicate_counters* counters) {
    const int turn_a = direction_side(a[0], a[1], a[2], d, counters);
    const int turn_b = direction_side(b[0], b[1], b[2], d, counters);
    const sides of_a(a, b, d, counters);
    if (of_a.apart(turn_b)) return std::nullopt;
    const sides of_b(b, a, d, counters);
    if (of_b.apart(turn_a)) return std::nullopt;

    first_of first(d, counters);
    for (std::size_t i = 0; i < 3; ++i) {
        if (turn_b != 0 && of_a.inside(i, turn_b))
            first.offer({corner(i), of_a.hit(i)}, a[i],
                        forwards({b[0], b[0], b[1], b[0], b[2]}, turn_b));
        if (turn_a != 0 && of_b.inside(i, turn_a))
            first.offer({of_b.hit(i), corner(i)}, a[0],
                        forwards({b[i], a[0], a[1], a[0], a[2]}, turn_a));
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            // Seen along the motion, the ends of each edge lie on either side of the other one.
            const int b0 = of_b.of[j][i], b1 = of_b.of[next(j)][i];
            const int a0 = of_a.of[i][j], a1 = of_a.of[next(i)][j];
            if (!opposite(b0, b1) || !opposite(a0, a1)) continue;
            // (p' - p) x (q' - q) . d is what the side grows by from q to q'.
            const int sign = b1 - b0 > 0 ? 1 : -1;
            first.offer({edge(i), edge(j)}, a[i],
                        forwards({b[j], a[i], a[next(i)], b[j], b[next(j)]}, sign));
        }
    if (turn_a == 0 && turn_b == 0) offer_flat(a, b, d, first, counters);
    return first.best;
}

int compare(const point3& d, const sweep_contact& a, const sweep_contact& b,
            predicate_counters* counters) {
    if (settled(a.time, b.time)) return a.time < b.time ? -1 : 1;
    return compare_cuts(d, a.from, a.until, b.from, b.until, counters);
}

}  // namespace treeform
