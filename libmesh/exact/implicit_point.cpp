#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/implicit_exact.hpp>
#include <libmesh/exact/implicit_filter.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/implicit_polynomials.hpp>
#include <libmesh/exact/staged_sign.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace treeform {
namespace {

using detail::exact::ball;
using detail::exact::ball_of;
using detail::exact::count_call;
using detail::exact::count_factor;
using detail::exact::sum;
using detail::exact::term;
using detail::exact::undecided;
using detail::exact::vector3;
using detail::exact::vector_of;

constexpr double u = 0x1p-52;
constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- where a point is, nearly

/// A computed number, and how far the exact one may be off.
struct estimate {
    double value;
    double error;
};

/// num / den.
///
/// Let num = num^ + e with |e| <= E and den = den^ + f with |f| <= F, where E and F are the bounds
/// of filter.hpp (the constant with one u more for the roundings here) and 2^-600, which is more
/// than underflow takes. With q = num^ / den^,
///     |num / den - q| = |e - q f| / |den| <= (E + |q| F) / (|den^| - F),
/// and the computed q^ is off q by u |q|. All is counted with fewer than eight roundings.
template <class Polynomial>
estimate ratio(const sum& num, const sum& den) {
    constexpr double factor = detail::exact::error_factor<Polynomial> + u;
    constexpr double lost = 0x1p-600;
    const double num_error = factor * num.magnitude + lost;
    const double den_error = factor * den.magnitude + lost;
    const double gap = std::abs(den.value) - den_error;
    if (!(gap > 0.0)) return {0.0, infinity};
    const double value = num.value / den.value;
    const double error = (num_error + std::abs(value) * den_error) / gap + 2 * u * std::abs(value);
    return {value, count_factor * error};
}

/// t d for a difference d as computed: it is off by u |d|, the product by u |t d| once more.
estimate scaled(const estimate& t, double d) {
    const double value = t.value * d;
    return {value, count_factor * (t.error * std::abs(d) + 3 * u * std::abs(value))};
}

/// The point base + (x, y, z), in a ball that is small for what it is computed from; otherwise
/// an infinite one.
///
/// The sum rounds by u times the coordinate. Before, operations that lose less than 2^-1020 each
/// were multiplied by at most 2^200: 2^-800 is more.
///
/// Small is a radius below 2^-30 of `size`, the size of what meets there, or not far above the
/// rounding of the coordinates. A larger one would leave open what an exact construction, that
/// costs as much as one undecided predicate, makes easy.
ball displaced(const point3& base, const estimate& x, const estimate& y, const estimate& z,
               double size) {
    const point3 center{base.x + x.value, base.y + y.value, base.z + z.value};
    const double error = std::max({x.error, y.error, z.error});
    const double reach = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    const double radius = count_factor * (error + u * reach) + 0x1p-800;
    return {center, radius <= std::max(0x1p-30 * size, 0x1p-46 * reach) ? radius : infinity};
}

template <class Vector, std::size_t Count>
auto terms_of(const std::array<Vector, Count>& differences) {
    return detail::exact::transform(differences, [](double x) { return term{x}; });
}

double size_of(const vector3<double>& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// a + t (b - a).
ball on_line(const point3& a, const point3& b, const estimate& t) {
    const auto d = vector_of(b) - vector_of(a);
    return displaced(a, scaled(t, d.x), scaled(t, d.y), scaled(t, d.z), size_of(d));
}

constexpr ball nowhere{{}, infinity};

ball lines_ball(const point3& a, const point3& b, const point3& c, const point3& d) {
    using polynomial = detail::exact::lines_polynomial;
    std::optional<detail::exact::vector2<sum>> steepest;
    for (int axis = 0; axis < 3; ++axis) {
        const auto differences = polynomial::differences(
            std::array{detail::exact::projection(axis, a), detail::exact::projection(axis, b),
                       detail::exact::projection(axis, c), detail::exact::projection(axis, d)});
        if (!(detail::exact::largest_magnitude(differences) <=
              detail::exact::largest_difference<3>))
            return nowhere;
        const auto t = polynomial::value(terms_of(differences));
        if (!steepest || std::abs(t.y.value) > std::abs(steepest->y.value)) steepest = t;
    }
    return on_line(a, b, ratio<polynomial>(steepest->x, steepest->y));
}

ball line_plane_ball(const point3& a, const point3& b, const plane_points& p) {
    using polynomial = detail::exact::line_plane_polynomial;
    const auto differences = polynomial::differences(
        std::array{vector_of(a), vector_of(b), vector_of(p.a), vector_of(p.b), vector_of(p.c)});
    if (!(detail::exact::largest_magnitude(differences) <=
          detail::exact::largest_difference<polynomial::degree>))
        return nowhere;
    const auto t = polynomial::value(terms_of(differences));
    return on_line(a, b, ratio<polynomial>(t.x, t.y));
}

ball line_normal_ball(const point3& a, const point3& b, const point3& at, const point3& normal) {
    using polynomial = detail::exact::line_normal_polynomial;
    const auto differences = polynomial::differences(std::array{
        vector_of(a), vector_of(b), vector_of(at), vector_of(point3{}), vector_of(normal)});
    if (!(detail::exact::largest_magnitude(differences) <= detail::exact::largest_difference<3>))
        return nowhere;
    const auto t = polynomial::value(terms_of(differences));
    return on_line(a, b, ratio<polynomial>(t.x, t.y));
}

ball planes_ball(const plane_points& p, const plane_points& q, const plane_points& r) {
    using polynomial = detail::exact::planes_polynomial;
    const auto d = polynomial::differences(
        std::array{vector_of(p.a), vector_of(p.b), vector_of(p.c), vector_of(q.a), vector_of(q.b),
                   vector_of(q.c), vector_of(r.a), vector_of(r.b), vector_of(r.c)});
    if (!(detail::exact::largest_magnitude(d) <=
          detail::exact::largest_difference<polynomial::degree>))
        return nowhere;
    const auto way = polynomial::value(terms_of(d));
    const double size =
        std::min({std::max(size_of(d[0]), size_of(d[1])), std::max(size_of(d[2]), size_of(d[3])),
                  std::max(size_of(d[4]), size_of(d[5]))});
    return displaced(p.a, ratio<polynomial>(way.over.x, way.under),
                     ratio<polynomial>(way.over.y, way.under),
                     ratio<polynomial>(way.over.z, way.under), size);
}

/// Whether the point is its center, by whatever it is defined.
bool is_center(const implicit_point& p) { return p.radius() == 0.0; }

/// The smallest ball about rounded coordinates, to a factor of two.
///
/// Rounding to nearest moves by half a unit in the last place, at most 2^-53 of the magnitude where
/// that is normal. A denormal radius might be read as zero: 2^-1022 instead.
ball exact_ball(const implicit_point& p) {
    ball result{};
    const auto coordinates = detail::exact::rounded_exactly(p, detail::exact::double_format);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double value = coordinates[axis].value;
        if (std::isinf(value)) {
            value = std::copysign(std::numeric_limits<double>::max(), value);
            result.radius = infinity;
        } else if (!coordinates[axis].exact) {
            result.radius = std::max({result.radius, 0x1p-53 * std::abs(value), 0x1p-1022});
        }
        result.center[axis] = value;
    }
    return result;
}

// ---- bits

/// Order of two finite doubles by their bits; -0 is 0.
int compare_bits(double a, double b) {
    const auto ordered = [](double x) {
        const auto bits = std::bit_cast<std::int64_t>(x);
        return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
    };
    return (ordered(a) > ordered(b)) - (ordered(a) < ordered(b));
}

/// Zero of either sign as +0; bits, since a denormal may compare equal to zero.
double without_negative_zero(double x) { return compare_bits(x, 0.0) == 0 ? 0.0 : x; }

/// The nearest float, ties to even, in any rounding mode. \pre |x| >= 2^-126
double nearest_normal_float(double x) {
    constexpr std::uint64_t dropped = 0x1fffffff;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const double rounded =
        std::bit_cast<double>((bits + (dropped >> 1) + (bits >> 29 & 1)) & ~dropped);
    return std::abs(rounded) < 0x1p128 ? rounded : std::copysign(infinity, rounded);
}

/// The float nearest to a number within `radius` of `center`, where that is certain.
///
/// The ends are moved outwards by 2 u |center|, more than the sums that make them round.
std::optional<double> certain_float(double center, double radius) {
    const double magnitude = std::abs(center);
    if (radius == 0.0 && compare_bits(center, 0.0) == 0) return 0.0;
    if (!(magnitude >= 0x1p-120 && radius <= 0x1p-20 * magnitude)) return {};
    if (radius == 0.0) return nearest_normal_float(center);
    const double off = count_factor * (radius + 2 * u * magnitude);
    const double low = nearest_normal_float(center - off);
    if (low != nearest_normal_float(center + off)) return {};
    return low;
}

point3 turned(int axis, const point3& p) {
    const detail::exact::vector2<double> others = detail::exact::projection(axis, p);
    return {others.x, others.y, p[static_cast<std::size_t>(axis)]};
}

}  // namespace

implicit_point::implicit_point(origin kind, const std::array<point3, 9>& definition,
                               const detail::exact::ball& about)
    : center_(about.center), radius_(about.radius), kind_(kind), definition_(definition) {
    if (radius_ < infinity) return;
    const ball exact = exact_ball(*this);
    center_ = exact.center;
    radius_ = exact.radius;
}

implicit_point implicit_point::where_lines_cross(const point3& a, const point3& b, const point3& c,
                                                 const point3& d) {
    return {origin::lines, {a, b, c, d}, lines_ball(a, b, c, d)};
}

implicit_point implicit_point::where_line_meets(const point3& a, const point3& b,
                                                const plane_points& plane) {
    return {origin::line_plane, {a, b, plane.a, plane.b, plane.c}, line_plane_ball(a, b, plane)};
}

implicit_point implicit_point::where_line_meets(const point3& a, const point3& b, const point3& at,
                                                const point3& normal) {
    return {origin::line_normal, {a, b, at, normal}, line_normal_ball(a, b, at, normal)};
}

implicit_point implicit_point::where_planes_meet(const plane_points& p, const plane_points& q,
                                                 const plane_points& r) {
    return {origin::planes, {p.a, p.b, p.c, q.a, q.b, q.c, r.a, r.b, r.c}, planes_ball(p, q, r)};
}

int compare(int axis, const implicit_point& a, const implicit_point& b,
            predicate_counters* counters) {
    const auto i = static_cast<std::size_t>(axis);
    const bool known = is_center(a) && is_center(b);
    const int sign = known ? compare_bits(a.center()[i], b.center()[i])
                           : detail::exact::compare_filter(axis, ball_of(a), ball_of(b));
    count_call(counters, sign == undecided);
    return sign != undecided ? sign : detail::exact::compare_exact(axis, a, b, counters);
}

bool equal(const implicit_point& a, const implicit_point& b, predicate_counters* counters) {
    if (is_center(a) && is_center(b)) {
        count_call(counters, false);
        return compare_bits(a.center().x, b.center().x) == 0 &&
               compare_bits(a.center().y, b.center().y) == 0 &&
               compare_bits(a.center().z, b.center().z) == 0;
    }
    const ball p = ball_of(a);
    const ball q = ball_of(b);
    const bool open = detail::exact::compare_filter(0, p, q) == undecided &&
                      detail::exact::compare_filter(1, p, q) == undecided &&
                      detail::exact::compare_filter(2, p, q) == undecided;
    count_call(counters, open);
    if (!open) return false;
    return detail::exact::equal_exact(a, b, counters);
}

int orient2d(int axis, const implicit_point& a, const implicit_point& b, const implicit_point& c,
             predicate_counters* counters) {
    if (is_center(a) && is_center(b) && is_center(c))
        return orient2d(axis, a.center(), b.center(), c.center(), counters);
    const int sign = detail::exact::orient2d_filter(axis, ball_of(a), ball_of(b), ball_of(c));
    count_call(counters, sign == undecided);
    return sign != undecided ? sign : detail::exact::orient2d_exact(axis, a, b, c, counters);
}

int side(const plane_points& p, const implicit_point& d, predicate_counters* counters) {
    if (is_center(d)) return orient3d(p.a, p.b, p.c, d.center(), counters);
    const int sign = detail::exact::side_filter(p, ball_of(d));
    count_call(counters, sign == undecided);
    return sign != undecided ? sign : detail::exact::side_exact(p, d, counters);
}

point3 rounded(const implicit_point& p) {
    const point3& c = p.center();
    // A radius above zero is never below half a unit in the last place of the largest coordinate.
    if (is_center(p))
        return {without_negative_zero(c.x), without_negative_zero(c.y), without_negative_zero(c.z)};
    const auto exact = detail::exact::rounded_exactly(p, detail::exact::double_format);
    return {exact[0].value, exact[1].value, exact[2].value};
}

point3 rounded_to_float(const implicit_point& p) {
    const auto x = certain_float(p.center().x, p.radius());
    const auto y = certain_float(p.center().y, p.radius());
    const auto z = certain_float(p.center().z, p.radius());
    if (x && y && z) return {*x, *y, *z};
    const auto exact = detail::exact::rounded_exactly(p, detail::exact::float_format_32);
    return {exact[0].value, exact[1].value, exact[2].value};
}

int normal_cross(int axis, const plane_points& p, const plane_points& q,
                 predicate_counters* counters) {
    const std::array points{turned(axis, p.a), turned(axis, p.b), turned(axis, p.c),
                            turned(axis, q.a), turned(axis, q.b), turned(axis, q.c)};
    using polynomial = detail::exact::normal_cross_polynomial;
    const auto& [a, b, c, d, e, f] = points;
    const int sign = detail::exact::filter_sign<polynomial>(a, b, c, d, e, f);
    count_call(counters, sign == undecided);
    if (sign != undecided) return sign;
    return detail::exact::exact_sign<polynomial>(
        {vector_of(a), vector_of(b), vector_of(c), vector_of(d), vector_of(e), vector_of(f)},
        counters);
}

}  // namespace treeform
