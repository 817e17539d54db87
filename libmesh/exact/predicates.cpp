#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/exact/staged_sign.hpp>
#include <libmesh/exact/stages.hpp>

namespace treeform {
namespace {

using detail::exact::count_call;
using detail::exact::sign_by_integers;
using detail::exact::staged_sign;
using detail::exact::undecided;

}  // namespace

namespace detail::exact {

int orient2d_exact(const point2& a, const point2& b, const point2& c,
                   predicate_counters* counters) {
    return sign_by_integers<orient2d_polynomial>(counters, a, b, c);
}

int orient2d_exact(int axis, const point3& a, const point3& b, const point3& c,
                   predicate_counters* counters) {
    return exact_sign<orient2d_polynomial>(
        {projection(axis, a), projection(axis, b), projection(axis, c)}, counters);
}

int orient3d_exact(const point3& a, const point3& b, const point3& c, const point3& d,
                   predicate_counters* counters) {
    return sign_by_integers<orient3d_polynomial>(counters, a, b, c, d);
}

}  // namespace detail::exact

int orient2d(const point2& a, const point2& b, const point2& c, predicate_counters* counters) {
    return staged_sign<detail::exact::orient2d_polynomial>(counters, a, b, c);
}

int orient2d(int axis, const point3& a, const point3& b, const point3& c,
             predicate_counters* counters) {
    const int sign = detail::exact::orient2d_filter(axis, a, b, c);
    count_call(counters, sign == undecided);
    return sign != undecided ? sign : detail::exact::orient2d_exact(axis, a, b, c, counters);
}

int orient3d(const point3& a, const point3& b, const point3& c, const point3& d,
             predicate_counters* counters) {
    return staged_sign<detail::exact::orient3d_polynomial>(counters, a, b, c, d);
}

bool collinear(const point3& a, const point3& b, const point3& c, predicate_counters* counters) {
    const int differs = detail::exact::collinear_filter(a, b, c);
    count_call(counters, differs == undecided);
    if (differs != undecided) return differs == 0;
    return sign_by_integers<detail::exact::normal_polynomial>(counters, a, b, c) == 0;
}

int compare_along(const point3& a, const point3& b, const point3& c, const point3& d,
                  predicate_counters* counters) {
    return staged_sign<detail::exact::compare_along_polynomial>(counters, a, b, c, d);
}

int compare_distance(const point3& a, const point3& b, const point3& c, const point3& d,
                     predicate_counters* counters) {
    return staged_sign<detail::exact::compare_distance_polynomial>(counters, a, b, c, d);
}

int normal_dot(const plane_points& p, const plane_points& q, predicate_counters* counters) {
    return staged_sign<detail::exact::normal_dot_polynomial>(counters, p.a, p.b, p.c, q.a, q.b,
                                                             q.c);
}

int normal_turn(const plane_points& p, const plane_points& q, const point3& a, const point3& b,
                predicate_counters* counters) {
    return staged_sign<detail::exact::normal_turn_polynomial>(counters, p.a, p.b, p.c, q.a, q.b,
                                                              q.c, a, b);
}

int normal_determinant(const plane_points& p, const plane_points& q, const plane_points& r,
                       predicate_counters* counters) {
    return staged_sign<detail::exact::normal_determinant_polynomial>(counters, p.a, p.b, p.c, q.a,
                                                                     q.b, q.c, r.a, r.b, r.c);
}

}  // namespace treeform
