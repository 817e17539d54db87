#include <libmesh/exact/exact_ratio.hpp>
#include <libmesh/exact/exact_sign.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/exact/plane_predicates.hpp>
#include <libmesh/exact/ray_polynomials.hpp>
#include <libmesh/exact/staged_sign.hpp>

#include <array>
#include <cmath>

namespace treeform {
namespace {

using detail::exact::staged_sign;
using detail::exact::vector_of;

constexpr point3 zero{};

/// Whether the filter's bound puts the value's relative error below 2^-42.
bool is_accurate(const detail::exact::sum& s) {
    return detail::exact::error_factor<detail::exact::cut_polynomial> * s.magnitude <=
               0x1p-42 * std::abs(s.value) &&
           s.magnitude >= detail::exact::least_permanent;
}

}  // namespace

int direction_side(const point3& a, const point3& b, const point3& c, const point3& d,
                   predicate_counters* counters) {
    return staged_sign<detail::exact::direction_side_polynomial>(counters, a, b, c, d, zero);
}

int line_side(int axis, const point3& o, const point3& d, const point3& p,
              predicate_counters* counters) {
    return staged_sign<detail::exact::line_side_polynomial>(
        counters, detail::exact::projection(axis, o), detail::exact::projection(axis, p),
        detail::exact::projection(axis, d), detail::exact::projection(axis, zero));
}

int compare_cuts(const point3& o, const point3& d, const cutting_plane& p, const cutting_plane& q,
                 predicate_counters* counters) {
    return compare_cuts(d, o, p, o, q, counters);
}

int compare_cuts(const point3& d, const point3& o, const cutting_plane& p, const point3& r,
                 const cutting_plane& q, predicate_counters* counters) {
    return staged_sign<detail::exact::compare_cuts_polynomial>(
        counters, o, d, zero, p.at, p.u_from, p.u_to, p.v_from, p.v_to, q.at, q.u_from, q.u_to,
        q.v_from, q.v_to, r);
}

int compare_cut(const point3& o, const point3& d, const cutting_plane& p, double s,
                predicate_counters* counters) {
    return staged_sign<detail::exact::compare_cut_polynomial>(
        counters, o, d, zero, p.at, p.u_from, p.u_to, p.v_from, p.v_to, point3{s, 1.0, 0.0});
}

double cut_parameter(const point3& o, const point3& d, const cutting_plane& p) {
    using polynomial = detail::exact::cut_polynomial;
    const std::array points{vector_of(o),        vector_of(d),        vector_of(zero),
                            vector_of(p.at),     vector_of(p.u_from), vector_of(p.u_to),
                            vector_of(p.v_from), vector_of(p.v_to)};
    const auto differences = polynomial::differences(points);
    const auto value = polynomial::value(
        detail::exact::transform(differences, [](double x) { return detail::exact::term{x}; }));
    // Two relative errors below 2^-42 and a rounding come to less than 2^-40.
    if (is_accurate(value.x) && is_accurate(value.y) &&
        detail::exact::largest_magnitude(differences) <=
            detail::exact::largest_difference<polynomial::degree>)
        return value.x.value / value.y.value;
    return detail::exact::exact_ratio<polynomial>(points);
}

}  // namespace treeform
