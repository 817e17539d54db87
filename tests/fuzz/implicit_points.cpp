/// \file
/// Constructed points, the questions about them, and their rounding, against GMP's rationals.

#include "bytes.hpp"
#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/tf.hpp>

#include <support/known_points.hpp>

#include <cmath>
#include <optional>

namespace {

using tf::fuzz::require;
using tf::test::known_point;

tf::plane_points plane(tf::fuzz::bytes& in) {
    tf::plane_points p;
    for (tf::point3* corner : {&p.a, &p.b, &p.c}) *corner = in.point();
    return p;
}

std::optional<known_point> any_point(tf::fuzz::bytes& in) {
    const std::size_t kind = in.below(5);
    if (kind == 0) return tf::test::given(in.point());
    const tf::plane_points p = plane(in);
    if (kind == 1) return tf::test::lines(p.a, p.b, p.c, in.point());
    if (kind == 4) return tf::test::line_normal(p.a, p.b, p.c, in.point());
    const tf::plane_points q = plane(in);
    if (kind == 2) return tf::test::line_plane(q.a, q.b, p);
    return tf::test::planes(p, q, plane(in));
}

/// Whether the double is as near to x as its neighbors are.
bool is_nearest(double rounded, const mpq_class& x) {
    if (!std::isfinite(rounded)) return abs(x) > mpq_class(1.79e308);
    const mpq_class off = abs(mpq_class(x - mpq_class(rounded)));
    for (const double toward : {-HUGE_VAL, HUGE_VAL}) {
        const double other = std::nextafter(rounded, toward);
        if (std::isfinite(other) && abs(mpq_class(x - mpq_class(other))) < off) return false;
    }
    return true;
}

int sign(const mpq_class& x) { return sgn(x); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tf::fuzz::bytes in(data, size);
    const auto p = any_point(in);
    const auto q = any_point(in);
    const auto r = any_point(in);
    if (!p || !q || !r) return -1;
    const tf::plane_points n = plane(in);
    require(tf::side(n, p->point) ==
                sign(tf::test::inner(tf::test::normal(n),
                                     tf::test::minus(p->at, tf::test::rational(n.a)))),
            "side");
    require(tf::equal(p->point, q->point) == (p->at == q->at), "equal");
    const auto turn = tf::test::outer(tf::test::minus(q->at, p->at), tf::test::minus(r->at, p->at));
    const tf::point3 rounded = tf::rounded(p->point);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(axis);
        require(tf::compare(a, p->point, q->point) == sign(p->at[axis] - q->at[axis]), "compare");
        require(tf::orient2d(a, p->point, q->point, r->point) == sign(turn[axis]), "orient2d");
        require(is_nearest(rounded[axis], p->at[axis]), "rounded");
    }
    return 0;
}
