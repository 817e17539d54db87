#pragma once
/// \file
/// The predicates in integers alone, and what two triangles have in common by these: each corner
/// and edge of one looked at against the other, nothing skipped. No filter and no short cut of the
/// library takes part; the integers are compared with GMP's in tests/oracle.

#include <libmesh/exact/exact_sign.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace treeform::test {

/// Sign of a polynomial of libmesh/exact/detail/polynomials.hpp.
template <class Polynomial, class... Points>
int integer_sign(const Points&... points) {
    return detail::exact::exact_sign<Polynomial>({detail::exact::vector_of(points)...}, nullptr);
}

inline int integer_orient3d(const point3& a, const point3& b, const point3& c, const point3& d) {
    return integer_sign<detail::exact::orient3d_polynomial>(a, b, c, d);
}
inline int integer_orient2d(int axis, const point3& a, const point3& b, const point3& c) {
    return integer_sign<detail::exact::orient2d_polynomial>(detail::exact::projection(axis, a),
                                                            detail::exact::projection(axis, b),
                                                            detail::exact::projection(axis, c));
}

/// All that two proper triangles have in common, except for the order of the ends.
class unfiltered_contacts {
  public:
    /// None when one of the two is degenerate.
    static std::optional<unfiltered_contacts> of(const triangle3& a, const triangle3& b) {
        const view of_a(a);
        const view of_b(b);
        if (of_a.up == 0 || of_b.up == 0) return {};
        return unfiltered_contacts(of_a, of_b);
    }

    [[nodiscard]] bool coplanar() const { return coplanar_; }
    [[nodiscard]] bool crossing() const { return crossing_; }
    [[nodiscard]] std::size_t count() const { return count_; }

    [[nodiscard]] bool agrees(const triangle_contact& found) const {
        return found.coplanar == coplanar_ && found.crossing == crossing_ &&
               found.count == count_ &&
               std::all_of(found.ends.begin(), found.ends.begin() + found.count,
                           [&](const feature_pair& c) { return has(c); });
    }

  private:
    using signs = std::array<int, 3>;

    /// A triangle and the axis along which it is seen with an area, `up` its sign.
    struct view {
        explicit view(const triangle3& triangle) : t(triangle) {
            for (axis = 0; axis < 3; ++axis)
                if ((up = integer_orient2d(axis, t[0], t[1], t[2])) != 0) return;
        }
        /// Where a point of its plane is: in which part of it, if any.
        [[nodiscard]] std::optional<triangle_feature> name_of(const point3& p) const {
            return part_of({turn(0, p), turn(1, p), turn(2, p)});
        }
        /// +1 when p is on the inner side of an edge, seen in its plane.
        [[nodiscard]] int turn(std::size_t edge, const point3& p) const {
            return up * integer_orient2d(axis, t[edge], t[(edge + 1) % 3], p);
        }
        const triangle3& t;
        int axis = 0;
        int up = 0;
    };

    /// The part of a triangle on which a point lies that has these sides of its edges.
    static std::optional<triangle_feature> part_of(const signs& sides) {
        if (std::ranges::count(sides, -1) > 0) return {};
        switch (std::ranges::count(sides, 0)) {
            case 0:
                return triangle_feature::interior;
            case 1:
                return static_cast<triangle_feature>(3 +
                                                     (std::ranges::find(sides, 0) - sides.begin()));
            default:  // edges i - 1 and i meet in corner i
                for (std::size_t i = 0; i < 3; ++i)
                    if (sides[i] == 0 && sides[(i + 2) % 3] == 0)
                        return static_cast<triangle_feature>(i);
                return {};
        }
    }

    unfiltered_contacts(const view& a, const view& b) {
        const signs of_a = sides(b, a);
        const signs of_b = sides(a, b);
        coplanar_ = of_a == signs{} && of_b == signs{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (of_a[i] == 0)
                if (const auto on_b = b.name_of(a.t[i]))
                    add({static_cast<triangle_feature>(i), *on_b});
            if (of_b[i] == 0)
                if (const auto on_a = a.name_of(b.t[i]))
                    add({*on_a, static_cast<triangle_feature>(i)});
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const auto edge = static_cast<triangle_feature>(3 + i);
            if (const auto on_b = pierced(a, of_a, i, b)) add({edge, *on_b});
            if (const auto on_a = pierced(b, of_b, i, a)) add({*on_a, edge});
            for (std::size_t k = 0; coplanar_ && k < 3; ++k)
                if (cross(a, i, b, k)) add({edge, static_cast<triangle_feature>(3 + k)});
        }
        crossing_ = count_ == 2 && !coplanar_ && straddles(of_a) && straddles(of_b);
    }

    static signs sides(const view& plane, const view& of) {
        const auto side = [&](const point3& p) {
            return integer_orient3d(plane.t[0], plane.t[1], plane.t[2], p);
        };
        return {side(of.t[0]), side(of.t[1]), side(of.t[2])};
    }
    static bool straddles(const signs& s) {
        return std::ranges::count(s, 1) > 0 && std::ranges::count(s, -1) > 0;
    }

    /// The part of `b` that edge i of `a` passes through; none where it ends there.
    static std::optional<triangle_feature> pierced(const view& a, const signs& of_a, std::size_t i,
                                                   const view& b) {
        const std::size_t next = (i + 1) % 3;
        if (of_a[i] * of_a[next] >= 0) return {};
        signs around;
        for (std::size_t k = 0; k < 3; ++k)
            around[k] = of_a[next] * integer_orient3d(a.t[i], a.t[next], b.t[k], b.t[(k + 1) % 3]);
        const auto part = part_of(around);
        // A corner of b on the edge has been met as a corner.
        return part && *part <= triangle_feature::v2 ? std::nullopt : part;
    }

    /// Whether two edges in one plane cross in their interiors.
    static bool cross(const view& a, std::size_t i, const view& b, std::size_t k) {
        const auto parted = [](const view& by, std::size_t edge, const view& of,
                               std::size_t other) {
            return by.turn(edge, of.t[other]) * by.turn(edge, of.t[(other + 1) % 3]) < 0;
        };
        return parted(a, i, b, k) && parted(b, k, a, i);
    }

    void add(const feature_pair& c) {
        if (!has(c)) ends_[count_++] = c;
    }
    [[nodiscard]] bool has(const feature_pair& c) const {
        const auto last = ends_.begin() + static_cast<std::ptrdiff_t>(count_);
        return std::find(ends_.begin(), last, c) != last;
    }

    std::array<feature_pair, 16> ends_{};
    std::size_t count_ = 0;
    bool coplanar_ = false;
    bool crossing_ = false;
};

}  // namespace treeform::test
