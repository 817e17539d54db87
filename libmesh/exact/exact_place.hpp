#pragma once
/// \file
/// The coordinates of a constructed point as exact quotients, and the values of predicates on them:
/// written once for integers of fixed width, numbers of any size, and a type that counts bits.
///
/// Widths. Coordinates are integers of at most m = 64 L - 3 bits on the lattice of the call. With a
/// coordinate counted as one degree, a value of degree k is kept in k L limbs, a bit of which is
/// the sign. Its magnitude is below 2^(k m + c), where c counts the bits that sums add; it fits
/// when k m + c < 64 k L, that is, c < 3 k. tests/unit/exact_bounds_test.cpp counts c for every
/// intermediate value of the text below.

#include <libmesh/exact/dyadic.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/implicit_polynomials.hpp>
#include <libmesh/exact/integer.hpp>
#include <libmesh/exact/vectors.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace treeform::detail::exact {

/// The types of places for coordinates of a number type: `small` for all points except
/// intersections of three planes, `large` for all points.
template <class Number>
struct places_of {
    using small = quotient_point<Number, Number>;
    using large = small;
};
template <std::size_t Limbs>
struct places_of<integer<Limbs>> {
    using small = quotient_point<integer<4 * Limbs>, integer<3 * Limbs>>;
    using large = quotient_point<integer<7 * Limbs>, integer<6 * Limbs>>;
};

/// The number 1.
template <class Number>
struct one_of {
    static constexpr Number value() { return {{1}}; }
};
template <>
struct one_of<dyadic> {
    static dyadic value() { return dyadic(1, false, 0); }
};

/// The number converted to another type that can represent it.
template <class To, class From>
constexpr To widened(From&& a) {
    if constexpr (std::is_same_v<To, std::remove_cvref_t<From>>) {
        return std::forward<From>(a);
    } else {
        To result;
        const std::uint64_t sign = a.negative() ? ~std::uint64_t{0} : 0;
        for (std::size_t i = 0; i < result.limbs.size(); ++i)
            result.limbs[i] = i < a.limbs.size() ? a.limbs[i] : sign;
        return result;
    }
}

template <class Place, class Over, class Under>
constexpr Place widened_place(Over&& x, Over&& y, Over&& z, Under&& under) {
    using over = std::remove_cvref_t<decltype(std::declval<Place>().over.x)>;
    using below = std::remove_cvref_t<decltype(std::declval<Place>().under)>;
    return {{widened<over>(std::forward<Over>(x)), widened<over>(std::forward<Over>(y)),
             widened<over>(std::forward<Over>(z))},
            widened<below>(std::forward<Under>(under))};
}

/// a + d t / w.
template <class Place, class Number, class Parameter>
constexpr Place place_along(const vector3<Number>& a, const vector3<Number>& d, const Parameter& t,
                            const Parameter& w) {
    return widened_place<Place>(w * a.x + t * d.x, w * a.y + t * d.y, w * a.z + t * d.z, w);
}

template <class Place, class Number>
constexpr Place place_of_lines(const vector3<Number>* p) {
    const auto along = p[1] - p[0];
    const auto other = p[3] - p[2];
    const auto under = cross(along, other);
    const auto over = cross(p[2] - p[0], other);
    // Use a projection in which the lines are not parallel.
    if (sign_of(under.x) != 0) return place_along<Place>(p[0], along, over.x, under.x);
    if (sign_of(under.y) != 0) return place_along<Place>(p[0], along, over.y, under.y);
    return place_along<Place>(p[0], along, over.z, under.z);
}

template <class Place, class Number>
constexpr Place place_of_line_plane(const vector3<Number>* p) {
    using polynomial = line_plane_polynomial;
    const auto d = polynomial::differences(std::array{p[0], p[1], p[2], p[3], p[4]});
    const auto t = polynomial::value(d);
    return place_along<Place>(p[0], d[0], t.x, t.y);
}

template <class Place, class Number>
constexpr Place place_of_line_normal(const vector3<Number>* p) {
    const auto t = line_normal_polynomial::value(std::array{p[1] - p[0], p[2] - p[0], p[3]});
    return place_along<Place>(p[0], p[1] - p[0], t.x, t.y);
}

template <class Place, class Number>
constexpr Place place_of_planes(const vector3<Number>* p) {
    using polynomial = planes_polynomial;
    const auto way = polynomial::value(
        polynomial::differences(std::array{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8]}));
    const auto& w = way.under;
    return widened_place<Place>(w * p[0].x + way.over.x, w * p[0].y + way.over.y,
                                w * p[0].z + way.over.z, w);
}

/// The point of the given kind that `p` defines. \pre three planes need `places_of<Number>::large`
template <class Place, class Number>
constexpr Place place_of(implicit_point::origin kind, const vector3<Number>* p) {
    using origin = implicit_point::origin;
    if (kind == origin::lines) return place_of_lines<Place>(p);
    if (kind == origin::line_plane) return place_of_line_plane<Place>(p);
    if (kind == origin::line_normal) return place_of_line_normal<Place>(p);
    if constexpr (std::is_same_v<Place, typename places_of<Number>::large>)
        if (kind == origin::planes) return place_of_planes<Place>(p);
    return widened_place<Place>(p->x, p->y, p->z, one_of<Number>::value());
}

template <class Number>
constexpr const Number& component(const vector3<Number>& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Sign of a - b, coordinate `axis`.
template <class Place>
constexpr int compare_places(int axis, const Place& a, const Place& b) {
    const auto difference = component(a.over, axis) * b.under - component(b.over, axis) * a.under;
    return sign_of(difference) * sign_of(a.under) * sign_of(b.under);
}

/// (p - o) times both denominators, without component `axis`, in cyclic order.
template <class Place>
constexpr auto projected_difference(int axis, const Place& p, const Place& o) {
    const auto difference = [&](int i) {
        return component(p.over, i) * o.under - component(o.over, i) * p.under;
    };
    return vector2<decltype(difference(0))>{difference((axis + 1) % 3), difference((axis + 2) % 3)};
}

/// Sign of component `axis` of (b - a) x (c - a).
template <class Place>
constexpr int orient2d_of_places(int axis, const Place& a, const Place& b, const Place& c) {
    const auto turn = cross(projected_difference(axis, b, a), projected_difference(axis, c, a));
    return sign_of(turn) * sign_of(b.under) * sign_of(c.under);
}

/// Sign of ((p[1] - p[0]) x (p[2] - p[0])) . (d - p[0]).
template <class Place, class Number>
constexpr int side_of_place(const vector3<Number>* p, const Place& d) {
    const auto n = cross(p[1] - p[0], p[2] - p[0]);
    const auto& w = d.under;
    const vector3<std::remove_cvref_t<decltype(d.over.x)>> way{
        d.over.x - w * p[0].x, d.over.y - w * p[0].y, d.over.z - w * p[0].z};
    return sign_of(dot(way, n)) * sign_of(w);
}

}  // namespace treeform::detail::exact
