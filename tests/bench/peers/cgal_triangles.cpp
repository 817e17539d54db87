#include "bench/peers/cgal_triangles.hpp"

#include <treeform/mesh/predicates.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <boost/variant/get.hpp>

#include <exception>

namespace treeform::bench {
namespace {

template <class Kernel>
signed char kind_of(const test::triangle_pair& pair) {
    const auto triangle = [](const triangle3& t) {
        const auto at = [](const point3& p) { return typename Kernel::Point_3(p.x, p.y, p.z); };
        return typename Kernel::Triangle_3(at(t[0]), at(t[1]), at(t[2]));
    };
    const auto common = CGAL::intersection(triangle(pair.a), triangle(pair.b));
    if (!common) return 0;
    if (boost::get<typename Kernel::Point_3>(&*common)) return 1;
    if (boost::get<typename Kernel::Segment_3>(&*common)) return 2;
    return 3;
}

template <class Kernel>
verdicts kinds_of(std::span<const test::triangle_pair> pairs) {
    verdicts result;
    for (const test::triangle_pair& pair : pairs) {
        try {
            result.push_back(kind_of<Kernel>(pair));
        } catch (const std::exception&) {
            result.push_back(kind_failed);
        }
    }
    return result;
}

}  // namespace

verdicts cgal_kinds(std::span<const test::triangle_pair> pairs, bool exact) {
    return exact ? kinds_of<CGAL::Exact_predicates_exact_constructions_kernel>(pairs)
                 : kinds_of<CGAL::Exact_predicates_inexact_constructions_kernel>(pairs);
}

}  // namespace treeform::bench
