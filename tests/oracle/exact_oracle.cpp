/// \file
/// Every predicate against GMP's integers, on groups of points of every family.
///
/// TREEFORM_STRESS_COUNT sets the calls of each predicate in each family (default 100,000):
///     TREEFORM_STRESS_COUNT=10000000 ctest --test-dir build/release -R exact_oracle -V

#include <libmesh/exact/constructed_point.hpp>
#include <libmesh/exact/predicates.hpp>

#include <doctest/doctest.h>
#include <gmpxx.h>
#include <support/point_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace {

using tf::point2;
using tf::point3;

using exact_vector = std::array<mpz_class, 3>;

/// The points times one power of two that makes all of them whole.
std::vector<exact_vector> whole(const std::vector<point3>& points) {
    struct parts {
        double mantissa;
        int exponent;
    };
    const auto split = [](double x) {
        int exponent = 0;
        const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);
        return parts{mantissa, exponent};
    };
    int least = std::numeric_limits<int>::max();
    for (const point3& p : points)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (p[axis] != 0.0) least = std::min(least, split(p[axis]).exponent);
    std::vector<exact_vector> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (points[i][axis] == 0.0) continue;
            const parts x = split(points[i][axis]);
            result[i][axis] = x.mantissa;
            result[i][axis] <<= static_cast<unsigned>(x.exponent - least);
        }
    }
    return result;
}

exact_vector minus(const exact_vector& a, const exact_vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

mpz_class inner(const exact_vector& a, const exact_vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

exact_vector outer(const exact_vector& a, const exact_vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

exact_vector normal(const std::vector<exact_vector>& p, std::size_t first) {
    return outer(minus(p[first + 1], p[first]), minus(p[first + 2], p[first]));
}

tf::plane_points plane(const std::vector<point3>& p, std::size_t first) {
    return {p[first], p[first + 1], p[first + 2]};
}

/// A predicate, how many points it takes, and its definition in exact arithmetic.
struct subject {
    const char* name;
    std::size_t points;
    int (*ours)(const std::vector<point3>&, tf::predicate_counters*);
    int (*truth)(const std::vector<exact_vector>&);
};

template <int Axis>
int crossed(const std::vector<point3>& p, tf::predicate_counters* counters) {
    return tf::normal_cross(Axis, plane(p, 0), plane(p, 3), counters);
}

template <std::size_t Axis>
int crossed_truth(const std::vector<exact_vector>& p) {
    return sgn(outer(normal(p, 0), normal(p, 3))[Axis]);
}

template <int Axis>
int projected(const std::vector<point3>& p, tf::predicate_counters* counters) {
    return tf::orient2d(Axis, p[0], p[1], p[2], counters);
}

template <std::size_t Axis>
int projected_truth(const std::vector<exact_vector>& p) {
    return sgn(normal(p, 0)[Axis]);
}

const std::array subjects = {
    subject{"orient2d", 3,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::orient2d(point2{p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y},
                                    counters);
            },
            projected_truth<2>},
    subject{"orient2d x", 3, projected<0>, projected_truth<0>},
    subject{"orient2d y", 3, projected<1>, projected_truth<1>},
    subject{"orient2d z", 3, projected<2>, projected_truth<2>},
    subject{"orient3d", 4,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::orient3d(p[0], p[1], p[2], p[3], counters);
            },
            [](const std::vector<exact_vector>& p) {
                return sgn(inner(normal(p, 0), minus(p[3], p[0])));
            }},
    subject{"collinear", 3,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::collinear(p[0], p[1], p[2], counters) ? 0 : 1;
            },
            [](const std::vector<exact_vector>& p) {
                const exact_vector n = normal(p, 0);
                return n[0] != 0 || n[1] != 0 || n[2] != 0 ? 1 : 0;
            }},
    subject{"compare_along", 4,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::compare_along(p[0], p[1], p[2], p[3], counters);
            },
            [](const std::vector<exact_vector>& p) {
                return sgn(inner(minus(p[1], p[0]), minus(p[3], p[2])));
            }},
    subject{"compare_distance", 4,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::compare_distance(p[0], p[1], p[2], p[3], counters);
            },
            [](const std::vector<exact_vector>& p) {
                const exact_vector first = minus(p[0], p[1]);
                const exact_vector second = minus(p[2], p[3]);
                return cmp(inner(first, first), inner(second, second));
            }},
    subject{
        "normal_dot", 6,
        [](const std::vector<point3>& p, tf::predicate_counters* counters) {
            return tf::normal_dot(plane(p, 0), plane(p, 3), counters);
        },
        [](const std::vector<exact_vector>& p) { return sgn(inner(normal(p, 0), normal(p, 3))); }},
    subject{"normal_cross x", 6, crossed<0>, crossed_truth<0>},
    subject{"normal_cross y", 6, crossed<1>, crossed_truth<1>},
    subject{"normal_cross z", 6, crossed<2>, crossed_truth<2>},
    subject{"normal_turn", 8,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::normal_turn(plane(p, 0), plane(p, 3), p[6], p[7], counters);
            },
            [](const std::vector<exact_vector>& p) {
                return sgn(inner(outer(normal(p, 0), normal(p, 3)), minus(p[7], p[6])));
            }},
    subject{"normal_determinant", 9,
            [](const std::vector<point3>& p, tf::predicate_counters* counters) {
                return tf::normal_determinant(plane(p, 0), plane(p, 3), plane(p, 6), counters);
            },
            [](const std::vector<exact_vector>& p) {
                return sgn(inner(outer(normal(p, 0), normal(p, 3)), normal(p, 6)));
            }},
};

long calls_per_family() {
    const char* count = std::getenv("TREEFORM_STRESS_COUNT");
    return count ? std::max(1L, std::atol(count)) : 100000;
}

struct tally {
    long zeros = 0;
    long wrong = 0;
    tf::predicate_counters counters;
};

tally run(const subject& predicate, tf::test::point_family family, long calls) {
    tf::test::point_stream stream(family, 1 + static_cast<std::uint64_t>(family));
    tally result;
    for (long i = 0; i < calls; ++i) {
        const std::vector<point3> points = stream.next(predicate.points);
        const int truth = predicate.truth(whole(points));
        result.zeros += truth == 0;
        result.wrong += predicate.ours(points, &result.counters) != (truth > 0) - (truth < 0);
    }
    return result;
}

TEST_CASE("every predicate has the sign that GMP's integers have") {
    const long calls = calls_per_family();
    std::printf("%-18s %-12s %10s %7s %9s %6s  %s\n", "predicate", "family", "calls", "zero %",
                "open %", "wrong", "decided at width 0..6");
    for (const subject& predicate : subjects) {
        for (std::size_t f = 0; f < tf::test::point_family_names.size(); ++f) {
            const std::string family(tf::test::point_family_names[f]);
            const tally t = run(predicate, static_cast<tf::test::point_family>(f), calls);
            const auto percent = [&](auto n) {
                return 100.0 * static_cast<double>(n) / static_cast<double>(calls);
            };
            std::printf("%-18s %-12s %10ld %7.2f %9.3f %6ld ", predicate.name, family.c_str(),
                        calls, percent(t.zeros), percent(t.counters.undecided), t.wrong);
            for (const std::uint64_t n : t.counters.by_width)
                std::printf(" %llu", static_cast<unsigned long long>(n));
            std::printf("\n");
            CAPTURE(predicate.name);
            CAPTURE(family);
            CHECK(t.wrong == 0);
            CHECK(t.counters.calls == static_cast<std::uint64_t>(calls));
        }
    }
}

}  // namespace
