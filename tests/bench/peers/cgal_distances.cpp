#include "bench/peers/cgal_distances.hpp"

#include "bench/peers/exact_number.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>
#include <mpfr.h>

#include <cmath>
#include <memory>
#include <utility>

namespace treeform::bench {
namespace {

using filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using exact = CGAL::Exact_predicates_exact_constructions_kernel;

template <class Kernel>
typename Kernel::Point_3 point_of(const point3& p) {
    return {p.x, p.y, p.z};
}

template <class Kernel>
typename Kernel::Triangle_3 triangle_of(const triangle3& t) {
    return {point_of<Kernel>(t[0]), point_of<Kernel>(t[1]), point_of<Kernel>(t[2])};
}

template <class Kernel>
typename Kernel::FT squared(distance_question question, const typename Kernel::Triangle_3& a,
                            const typename Kernel::Triangle_3& b) {
    return question == distance_question::point_triangle ? CGAL::squared_distance(b.vertex(0), a)
                                                         : CGAL::squared_distance(a, b);
}

template <class Kernel>
distance_asker asker_of(distance_question question, std::span<const test::triangle_pair> pairs) {
    using triangle = typename Kernel::Triangle_3;
    const auto given = std::make_shared<std::vector<std::pair<triangle, triangle>>>();
    for (const auto& [a, b] : pairs)
        given->emplace_back(triangle_of<Kernel>(a), triangle_of<Kernel>(b));
    return [given, question](std::vector<double>& found) {
        for (std::size_t i = 0; i < given->size(); ++i) {
            const auto& [a, b] = (*given)[i];
            const typename Kernel::FT d = squared<Kernel>(question, a, b);
            CGAL::exact(d);
            found[i] = std::sqrt(CGAL::to_double(d));
        }
    };
}

true_distance root_of(const exact::FT& squared) {
    mpfr_t root, rest;
    mpfr_inits2(300, root, rest, nullptr);
    mpfr_set_q(root, raw_rational(CGAL::exact(squared)), MPFR_RNDN);
    mpfr_sqrt(root, root, MPFR_RNDN);
    true_distance result{.rounded = mpfr_get_d(root, MPFR_RNDN)};
    mpfr_sub_d(rest, root, result.rounded, MPFR_RNDN);
    result.rest = mpfr_get_d(rest, MPFR_RNDN);
    mpfr_clears(root, rest, nullptr);
    return result;
}

}  // namespace

distance_asker cgal_rounded_distances(distance_question question,
                                      std::span<const test::triangle_pair> pairs) {
    return asker_of<filtered>(question, pairs);
}

distance_asker cgal_exact_distances(distance_question question,
                                    std::span<const test::triangle_pair> pairs) {
    return asker_of<exact>(question, pairs);
}

std::vector<true_distance> cgal_true_distances(distance_question question,
                                               std::span<const test::triangle_pair> pairs) {
    std::vector<true_distance> result;
    for (const auto& [a, b] : pairs)
        result.push_back(
            root_of(squared<exact>(question, triangle_of<exact>(a), triangle_of<exact>(b))));
    return result;
}

}  // namespace treeform::bench
