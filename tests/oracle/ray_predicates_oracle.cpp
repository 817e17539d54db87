/// \file
/// The predicates about lines against GMP's rationals, on groups of points of every family.
///
/// TREEFORM_STRESS_COUNT sets the calls of each in each family (default 20,000).

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/known_points.hpp>
#include <support/point_families.hpp>
#include <support/settings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using tf::point3;
using tf::test::inner;
using tf::test::minus;
using tf::test::normal;
using tf::test::outer;
using tf::test::rational;
using tf::test::rational_vector;

rational_vector normal(const tf::cutting_plane& p) {
    return outer(minus(p.u_to, p.u_from), minus(p.v_to, p.v_from));
}
mpq_class parameter(const point3& o, const point3& d, const tf::cutting_plane& p) {
    const rational_vector n = normal(p);
    return inner(n, minus(p.at, o)) / inner(n, rational(d));
}

/// The plane on five points from `first` on, turned so that d points to its positive side; false
/// when it is parallel to d.
bool turned_plane(const std::vector<point3>& p, std::size_t first, const point3& d,
                  tf::cutting_plane& plane) {
    plane = {p[first], p[first + 1], p[first + 2], p[first + 3], p[first + 4]};
    const mpq_class along = inner(normal(plane), rational(d));
    if (along < 0) {
        std::swap(plane.u_from, plane.v_from);
        std::swap(plane.u_to, plane.v_to);
    }
    return along != 0;
}

long ray_calls() { return std::max(1L, static_cast<long>(test::stress_count(20000))); }

struct sign_tally {
    long calls = 0, zeros = 0, wrong = 0;
    void add(int ours, int truth) {
        ++calls;
        zeros += truth == 0;
        wrong += ours != (truth > 0) - (truth < 0);
    }
};

/// Whether t is within 2^-40 of the exact parameter, or beyond the range of double as that is.
bool is_close(double t, const mpq_class& exact) {
    const mpq_class size = abs(exact);
    if (exact == 0) return t == 0.0;
    if (size >= mpq_class(std::numeric_limits<double>::max()))
        return std::abs(t) > 0x1.fffffffp1023;
    if (size < mpq_class(0x1p-1020)) return std::abs(t) < 0x1p-1019;
    return abs(mpq_class(t) - exact) * mpq_class(0x1p40) < size;
}

TEST_CASE("predicates about lines agree with GMP's rationals, and parameters nearly") {
    const long calls = ray_calls();
    for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
        const std::string family(tf::test::point_family_names[f]);
        CAPTURE(family);
        tf::test::point_stream stream(static_cast<tf::test::point_family>(f), 100 + f);
        sign_tally side, left, cuts, cut;
        long far_off = 0;
        tf::predicate_counters counters;
        for (long i = 0; i < calls; ++i) {
            auto p = stream.next(12);
            const point3& o = p[0];
            const point3& d = p[1];
            if (i % 4 == 0) p[7] = p[2];  // planes through one point
            side.add(tf::direction_side(o, p[2], p[3], d, &counters),
                     sgn(inner(outer(minus(p[2], o), minus(p[3], o)), rational(d))));
            const int axis = static_cast<int>(i % 3);
            left.add(tf::line_side(axis, o, d, p[2], &counters),
                     sgn(outer(rational(d), minus(p[2], o))[static_cast<std::size_t>(axis)]));
            tf::cutting_plane a{}, b{};
            if (!turned_plane(p, 2, d, a)) continue;
            const mpq_class t = parameter(o, d, a);
            const double approximate = tf::cut_parameter(o, d, a);
            far_off += !is_close(approximate, t);
            if (std::isfinite(approximate))
                cut.add(tf::compare_cut(o, d, a, approximate, &counters),
                        cmp(t, mpq_class(approximate)));
            cut.add(tf::compare_cut(o, d, a, p[9].x, &counters), cmp(t, mpq_class(p[9].x)));
            if (!turned_plane(p, 7, d, b)) continue;
            cuts.add(tf::compare_cuts(o, d, a, b, &counters), cmp(t, parameter(o, d, b)));
            const point3& r = i % 3 == 0 ? p[7] : p[4];
            cuts.add(tf::compare_cuts(d, o, a, r, b, &counters), cmp(t, parameter(r, d, b)));
        }
        std::printf("%-12s", family.c_str());
        for (const sign_tally* t : {&side, &left, &cut, &cuts}) {
            std::printf(" %7ld calls %6ld zero %ld wrong;", t->calls, t->zeros, t->wrong);
            CHECK(t->wrong == 0);
        }
        std::printf(" %ld far off, %llu undecided\n", far_off,
                    static_cast<unsigned long long>(counters.undecided));
        CHECK(far_off == 0);
    }
}

}  // namespace
