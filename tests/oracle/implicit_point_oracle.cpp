/// \file
/// Constructed points and their predicates against GMP's rationals, their rounding against MPFR,
/// on groups of planes and lines of every kind of trouble.
///
/// TREEFORM_STRESS_COUNT sets the calls of each predicate in each family (default 20,000).

#include <libmesh/exact/dyadic.hpp>
#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <mpfr.h>
#include <support/known_points.hpp>
#include <support/point_families.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using tf::implicit_point;
using tf::plane_points;
using tf::point3;
using tf::test::random_source;

using tf::test::given;
using tf::test::inner;
using tf::test::known_point;
using tf::test::line_normal;
using tf::test::line_plane;
using tf::test::lines;
using tf::test::minus;
using tf::test::normal;
using tf::test::outer;
using tf::test::planes;
using tf::test::rational;

/// What is hard about a group of six planes.
enum class family : std::uint8_t {
    random,
    small_grid,       ///< whole numbers from 0 to 4: many zeros
    nearly_parallel,  ///< two planes that differ by ulps
    nearly_one,       ///< four such
    far_away,         ///< small and far from the origin
    far_and_parallel,
    wide,     ///< exponents of -1000 to 1000
    largest,  ///< up to the end of the range: points beyond it
    stream,   ///< point_stream's families follow
};
constexpr std::array<std::string_view, 8> family_names = {
    "random",           "small_grid", "nearly_parallel", "nearly_one", "far_away",
    "far_and_parallel", "wide",       "largest"};
constexpr std::size_t families = family_names.size() + tf::test::point_family_names.size();

std::string_view name_of(std::size_t f) {
    return f < family_names.size() ? family_names[f]
                                   : tf::test::point_family_names[f - family_names.size()];
}

class groups {
  public:
    groups(std::size_t f, std::uint64_t seed)
        : family_(std::min(f, family_names.size())),
          random_(seed),
          stream_(static_cast<tf::test::point_family>(
                      f < family_names.size() ? 0 : f - family_names.size()),
                  seed) {}

    [[nodiscard]] random_source& random() { return random_; }

    [[nodiscard]] std::vector<plane_points> next() {
        std::vector<point3> p = stream_.next(18);
        if (family_ < family_names.size())
            for (point3& x : p) x = {coordinate(), coordinate(), coordinate()};
        std::vector<plane_points> result;
        for (std::size_t i = 0; i < 18; i += 3) result.push_back({p[i], p[i + 1], p[i + 2]});
        const auto f = static_cast<family>(family_);
        if (f == family::nearly_parallel || f == family::far_and_parallel)
            result[1] = moved(result[0]);
        if (f == family::nearly_one)
            for (std::size_t i = 2; i < 6; ++i) result[i] = moved(result[2]);
        return result;
    }

    /// Two lines of one plane, when rounding leaves them so.
    [[nodiscard]] std::optional<known_point> crossing(const plane_points& p) {
        // In a plane along two axes any lines will do; elsewhere combinations of few bits.
        if (random_.one_in(3)) {
            const std::size_t axis = random_.below(3);
            std::array<point3, 4> ends{p.a, p.b, p.c, {p.b.z, p.a.y, p.c.x}};
            for (point3& e : ends) e[axis] = p.a[axis];
            return lines(ends[0], ends[1], ends[2], ends[3]);
        }
        const auto combined = [&] {
            const double s = random_.whole(-4, 4), t = random_.whole(-4, 4);
            point3 result;
            for (std::size_t i = 0; i < 3; ++i)
                result[i] = p.a[i] + s * (p.b[i] - p.a[i]) + t * (p.c[i] - p.a[i]);
            return result;
        };
        const auto finite = [](const point3& x) {
            return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
        };
        std::array<point3, 4> ends{p.a, combined(), combined(), combined()};
        for (const point3& e : ends)
            if (!finite(e)) return {};
        if (auto found = lines(ends[0], ends[1], ends[2], ends[3])) return found;
        return lines(p.a, p.b, p.a, p.c);  // that is, p.a
    }

  private:
    double coordinate() {
        const double x = 2.0 * random_.unit() - 1.0;
        switch (static_cast<family>(family_)) {
            case family::small_grid:
                return random_.whole(0, 4);
            case family::far_away:
            case family::far_and_parallel:
                return 0x1.234567p20 + x;
            case family::wide:
                return std::ldexp(x, static_cast<int>(random_.below(2000)) - 1000);
            case family::largest:
                return std::ldexp(x, 1024);
            default:
                return x;
        }
    }
    plane_points moved(plane_points p) {
        for (point3* corner : {&p.a, &p.b, &p.c})
            for (std::size_t i = 0; i < 3; ++i)
                if (random_.one_in(2))
                    (*corner)[i] = std::nextafter((*corner)[i], random_.one_in(2) ? 1e308 : -1e308);
        return p;
    }

    std::size_t family_;
    random_source random_;
    tf::test::point_stream stream_;
};

/// The nearest number of a format, by MPFR.
double nearest(const mpq_class& x, mpfr_prec_t precision, mpfr_exp_t least, mpfr_exp_t greatest) {
    mpfr_set_emin(least);
    mpfr_set_emax(greatest);
    mpfr_t result;
    mpfr_init2(result, precision);
    const int order = mpfr_set_q(result, x.get_mpq_t(), MPFR_RNDN);
    mpfr_subnormalize(result, order, MPFR_RNDN);
    const double value = mpfr_get_d(result, MPFR_RNDN);
    mpfr_clear(result);
    return value == 0.0 ? 0.0 : value;
}
double nearest_double(const mpq_class& x) { return nearest(x, 53, -1073, 1024); }
double nearest_float(const mpq_class& x) { return nearest(x, 24, -148, 128); }

struct tally {
    long calls = 0, zeros = 0, wrong = 0;
    void add(int ours, int truth) {
        ++calls;
        zeros += truth == 0;
        wrong += ours != (truth > 0) - (truth < 0);
    }
};

struct tallies {
    tally compare, equal, orient2d, side, normal_cross, ball, rounded;
    long beyond_double = 0;
    tf::predicate_counters counters;
};

/// Whether the ball holds the point and is infinite only where it must be.
bool is_held(const known_point& p) {
    const point3& c = p.point.center();
    if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) return false;
    if (std::isinf(p.point.radius()))
        return std::any_of(p.at.begin(), p.at.end(),
                           [](const mpq_class& x) { return std::isinf(nearest_double(x)); });
    const mpq_class radius(p.point.radius());
    for (std::size_t i = 0; i < 3; ++i)
        if (abs(p.at[i] - mpq_class(c[i])) > radius) return false;
    return true;
}

bool is_rounded(const known_point& p) {
    const point3 nearest = tf::rounded(p.point);
    const point3 nearest_in_float = tf::rounded_to_float(p.point);
    for (std::size_t i = 0; i < 3; ++i)
        if (nearest[i] != nearest_double(p.at[i]) || nearest_in_float[i] != nearest_float(p.at[i]))
            return false;
    return true;
}

/// A given point that is off by few radii, or few units in the last place.
known_point beside(const known_point& p, random_source& random) {
    point3 near = tf::rounded(p.point);
    for (std::size_t i = 0; i < 3; ++i) {
        if (!std::isfinite(near[i])) return given({});
        if (random.one_in(2)) near[i] = std::nextafter(near[i], random.one_in(2) ? 1e308 : -1e308);
        const double moved = near[i] + p.point.radius() * random.whole(-8, 8) / 4.0;
        if (random.one_in(2) && std::isfinite(moved)) near[i] = moved;
    }
    return given(near);
}

/// Points of all kinds; the first three on a line, the next two nearly always one point.
std::vector<known_point> points_of(groups& from, const std::vector<plane_points>& t) {
    std::vector<known_point> points;
    const auto add = [&](const std::optional<known_point>& p) {
        if (p) points.push_back(*p);
    };
    add(planes(t[0], t[1], t[2]));
    add(planes(t[1], t[3], t[0]));
    add(from.random().one_in(2) ? planes(t[4], t[0], t[1]) : line_plane(t[0].a, t[0].b, t[1]));
    add(line_plane(t[2].a, t[2].b, t[3]));
    add(line_normal(t[2].a, t[2].b, t[3].a, t[3].b));
    add(planes({t[2].b, t[2].c, t[2].a}, {t[2].a, t[2].b, t[4].c}, t[3]));
    add(line_plane(t[3].a, t[3].b, t[2]));
    add(from.crossing(t[4]));
    add(from.crossing(t[2]));
    points.push_back(given(t[0].c));
    points.push_back(given(t[1].a));
    return points;
}

void run(groups& from, tallies& result) {
    const std::vector<plane_points> t = from.next();
    const std::vector<known_point> points = points_of(from, t);
    tf::predicate_counters* counters = &result.counters;
    for (const known_point& p : points) {
        result.beyond_double += std::isinf(p.point.radius());
        result.ball.add(is_held(p) ? 0 : 1, 0);
        result.rounded.add(is_rounded(p) ? 0 : 1, 0);
    }
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < t.size(); i += 2)
            result.normal_cross.add(
                tf::normal_cross(axis, t[i], t[i + 1], counters),
                sgn(outer(normal(t[i]), normal(t[i + 1]))[static_cast<std::size_t>(axis)]));
    const std::size_t count = points.size();
    const auto any = [&]() -> const known_point& { return points[from.random().below(count)]; };
    const int axis = static_cast<int>(from.random().below(3));
    const auto component = static_cast<std::size_t>(axis);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const known_point& p = points[i];
        const known_point& q = from.random().one_in(2) ? points[i + 1] : any();
        const known_point& r = from.random().one_in(2) ? points[(i + 2) % count] : any();
        result.compare.add(tf::compare(axis, p.point, q.point, counters),
                           cmp(p.at[component], q.at[component]));
        result.equal.add(tf::equal(p.point, q.point, counters) ? 0 : 1, p.at == q.at ? 0 : 1);
        result.orient2d.add(tf::orient2d(axis, p.point, q.point, r.point, counters),
                            sgn(outer(minus(q.at, p.at), minus(r.at, p.at))[component]));
        const known_point near = beside(p, from.random());
        result.compare.add(tf::compare(axis, p.point, near.point, counters),
                           cmp(p.at[component], near.at[component]));
        result.equal.add(tf::equal(near.point, p.point, counters) ? 0 : 1, near.at == p.at ? 0 : 1);
        result.orient2d.add(tf::orient2d(axis, p.point, q.point, near.point, counters),
                            sgn(outer(minus(q.at, p.at), minus(near.at, p.at))[component]));
        const plane_points& plane = t[from.random().below(t.size())];
        result.side.add(tf::side(plane, p.point, counters),
                        sgn(inner(normal(plane), minus(p.at, rational(plane.a)))));
    }
}

mpq_class rational_of(const tf::detail::exact::dyadic& a) {
    mpz_class magnitude;
    mpz_import(magnitude.get_mpz_t(), a.size(), -1, 8, 0, 0, a.limbs());
    mpq_class result(a.sign() < 0 ? mpz_class(-magnitude) : magnitude);
    const auto bits = static_cast<mp_bitcnt_t>(64 * std::abs(a.exponent()));
    if (a.exponent() < 0)
        mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), bits);
    else
        mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), bits);
    return result;
}

/// Up to eight doubles of any exponents, multiplied and added.
tf::detail::exact::dyadic any_dyadic(tf::test::point_stream& stream) {
    using tf::detail::exact::dyadic;
    const std::vector<point3> p = stream.next(3);
    return dyadic(p[0].x) * dyadic(p[0].y) * dyadic(p[0].z) - dyadic(p[1].x) * dyadic(p[1].y) +
           dyadic(p[1].z) * dyadic(p[2].x) * dyadic(p[2].y);
}

long calls_per_family() { return std::max(1L, static_cast<long>(test::stress_count(5000))); }

TEST_CASE("constructed points are where GMP's rationals are, and so are all signs and roundings") {
    const long calls = calls_per_family();
    for (std::size_t f = 0; f < families; ++f) {
        CAPTURE(name_of(f));
        groups from(f, 300 + f);
        tallies t;
        while (t.side.calls < calls || t.normal_cross.calls < calls) run(from, t);
        // calls / zeros (or equal, or right) / wrong
        std::printf("%-16s", std::string(name_of(f)).c_str());
        for (const tally* one :
             {&t.compare, &t.equal, &t.orient2d, &t.side, &t.normal_cross, &t.ball, &t.rounded}) {
            std::printf(" %ld/%ld/%ld", one->calls, one->zeros, one->wrong);
            CHECK(one->wrong == 0);
        }
        std::printf(" open %.1f %%, %ld beyond double\n",
                    100.0 * static_cast<double>(t.counters.undecided) /
                        static_cast<double>(t.counters.calls),
                    t.beyond_double);
    }
}

TEST_CASE("numbers of any size add, multiply and round as GMP's and MPFR's do") {
    using tf::detail::exact::quotient;
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        CAPTURE(tf::test::point_family_names[f]);
        tf::test::point_stream stream(static_cast<tf::test::point_family>(f), 900 + f);
        for (long i = 0; i < calls_per_family(); ++i) {
            const auto a = any_dyadic(stream);
            const auto b = any_dyadic(stream);
            const mpq_class p = rational_of(a), q = rational_of(b);
            REQUIRE(a.sign() == sgn(p));
            REQUIRE(rational_of(a + b) == p + q);
            REQUIRE(rational_of(a - b) == p - q);
            REQUIRE(rational_of(a * b) == p * q);
            if (q == 0) continue;
            const auto in_double = quotient(a, b, 0, tf::detail::exact::double_format);
            REQUIRE(in_double.value == nearest_double(p / q));
            if (std::isfinite(in_double.value))
                REQUIRE(in_double.exact == (mpq_class(in_double.value) == p / q));
            REQUIRE(quotient(a, b, 0, tf::detail::exact::float_format_32).value ==
                    nearest_float(p / q));
        }
    }
}

}  // namespace
