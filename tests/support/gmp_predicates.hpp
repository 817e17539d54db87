#pragma once
/// \file
/// The predicates and what they mean in GMP's integers.

#include <libmesh/exact/implicit_point.hpp>
#include <libmesh/exact/plane_predicates.hpp>

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace treeform::test {

using exact_vector = std::array<mpz_class, 3>;

/// The points times one power of two that makes all of them whole.
inline std::vector<exact_vector> whole(const std::vector<point3>& points) {
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

inline exact_vector minus(const exact_vector& a, const exact_vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline mpz_class inner(const exact_vector& a, const exact_vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline exact_vector outer(const exact_vector& a, const exact_vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline exact_vector normal(const std::vector<exact_vector>& p, std::size_t first) {
    return outer(minus(p[first + 1], p[first]), minus(p[first + 2], p[first]));
}

inline plane_points plane(const std::vector<point3>& p, std::size_t first) {
    return {p[first], p[first + 1], p[first + 2]};
}

/// A predicate, how many points it takes, and its definition in exact arithmetic. `truth` has the
/// sign of the answer, not its size.
struct gmp_predicate {
    const char* name;
    std::size_t points;
    int (*ours)(const std::vector<point3>&, predicate_counters*);
    int (*truth)(const std::vector<exact_vector>&);
};

template <int Axis>
int crossed(const std::vector<point3>& p, predicate_counters* counters) {
    return normal_cross(Axis, plane(p, 0), plane(p, 3), counters);
}

template <std::size_t Axis>
int crossed_truth(const std::vector<exact_vector>& p) {
    return sgn(outer(normal(p, 0), normal(p, 3))[Axis]);
}

template <int Axis>
int projected(const std::vector<point3>& p, predicate_counters* counters) {
    return orient2d(Axis, p[0], p[1], p[2], counters);
}

template <std::size_t Axis>
int projected_truth(const std::vector<exact_vector>& p) {
    return sgn(normal(p, 0)[Axis]);
}

inline const std::array gmp_predicates = {
    gmp_predicate{
        "orient2d", 3,
        [](const std::vector<point3>& p, predicate_counters* counters) {
            return orient2d(point2{p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y}, counters);
        },
        projected_truth<2>},
    gmp_predicate{"orient2d x", 3, projected<0>, projected_truth<0>},
    gmp_predicate{"orient2d y", 3, projected<1>, projected_truth<1>},
    gmp_predicate{"orient2d z", 3, projected<2>, projected_truth<2>},
    gmp_predicate{"orient3d", 4,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return orient3d(p[0], p[1], p[2], p[3], counters);
                  },
                  [](const std::vector<exact_vector>& p) {
                      return sgn(inner(normal(p, 0), minus(p[3], p[0])));
                  }},
    gmp_predicate{"collinear", 3,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return collinear(p[0], p[1], p[2], counters) ? 0 : 1;
                  },
                  [](const std::vector<exact_vector>& p) {
                      const exact_vector n = normal(p, 0);
                      return n[0] != 0 || n[1] != 0 || n[2] != 0 ? 1 : 0;
                  }},
    gmp_predicate{"compare_along", 4,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return compare_along(p[0], p[1], p[2], p[3], counters);
                  },
                  [](const std::vector<exact_vector>& p) {
                      return sgn(inner(minus(p[1], p[0]), minus(p[3], p[2])));
                  }},
    gmp_predicate{"compare_distance", 4,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return compare_distance(p[0], p[1], p[2], p[3], counters);
                  },
                  [](const std::vector<exact_vector>& p) {
                      const exact_vector first = minus(p[0], p[1]);
                      const exact_vector second = minus(p[2], p[3]);
                      return cmp(inner(first, first), inner(second, second));
                  }},
    gmp_predicate{
        "normal_dot", 6,
        [](const std::vector<point3>& p, predicate_counters* counters) {
            return normal_dot(plane(p, 0), plane(p, 3), counters);
        },
        [](const std::vector<exact_vector>& p) { return sgn(inner(normal(p, 0), normal(p, 3))); }},
    gmp_predicate{"normal_cross x", 6, crossed<0>, crossed_truth<0>},
    gmp_predicate{"normal_cross y", 6, crossed<1>, crossed_truth<1>},
    gmp_predicate{"normal_cross z", 6, crossed<2>, crossed_truth<2>},
    gmp_predicate{"normal_turn", 8,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return normal_turn(plane(p, 0), plane(p, 3), p[6], p[7], counters);
                  },
                  [](const std::vector<exact_vector>& p) {
                      return sgn(inner(outer(normal(p, 0), normal(p, 3)), minus(p[7], p[6])));
                  }},
    gmp_predicate{"normal_determinant", 9,
                  [](const std::vector<point3>& p, predicate_counters* counters) {
                      return normal_determinant(plane(p, 0), plane(p, 3), plane(p, 6), counters);
                  },
                  [](const std::vector<exact_vector>& p) {
                      return sgn(inner(outer(normal(p, 0), normal(p, 3)), normal(p, 6)));
                  }},
};

}  // namespace treeform::test
