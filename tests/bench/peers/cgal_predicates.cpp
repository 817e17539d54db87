#include "bench/peers/cgal_predicates.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/enum.h>
#include <CGAL/intersections.h>

#include <array>
#include <memory>

namespace treeform::bench {
namespace {

template <class Kernel>
struct converted {
    std::array<typename Kernel::Point_3, 3> a, b;
    std::array<typename Kernel::Point_2, 3> flat;  // a0, a1, b0
    typename Kernel::Triangle_3 first, second;
};

template <class Kernel>
converted<Kernel> convert(const test::triangle_pair& pair) {
    const auto point = [](const point3& p) { return typename Kernel::Point_3(p.x, p.y, p.z); };
    const auto flat = [](const point3& p) { return typename Kernel::Point_2(p.x, p.y); };
    const auto& [a, b] = pair;
    return {.a = {point(a[0]), point(a[1]), point(a[2])},
            .b = {point(b[0]), point(b[1]), point(b[2])},
            .flat = {flat(a[0]), flat(a[1]), flat(b[0])},
            .first = {point(a[0]), point(a[1]), point(a[2])},
            .second = {point(b[0]), point(b[1]), point(b[2])}};
}

template <class Kernel, question Question>
int answer(const Kernel& kernel, const converted<Kernel>& pair) {
    const auto& [a, b, flat, first, second] = pair;
    if constexpr (Question == question::orient2d)
        return kernel.orientation_2_object()(flat[0], flat[1], flat[2]);
    else if constexpr (Question == question::orient3d)
        return kernel.orientation_3_object()(a[0], a[1], a[2], b[0]);
    else if constexpr (Question == question::collinear)
        return kernel.collinear_3_object()(a[0], a[1], b[0]) ? 1 : 0;
    else if constexpr (Question == question::compare_along)
        return kernel.angle_3_object()(a[0], a[1], b[0], b[1]);
    else if constexpr (Question == question::compare_distance)
        return kernel.compare_distance_3_object()(a[0], a[1], b[0], b[1]);
    else
        return kernel.do_intersect_3_object()(first, second) ? 1 : 0;
}

template <class Kernel, question Question>
asker asker_of(std::span<const test::triangle_pair> pairs) {
    const auto given = std::make_shared<std::vector<converted<Kernel>>>();
    given->reserve(pairs.size());
    for (const auto& pair : pairs) given->push_back(convert<Kernel>(pair));
    return [given](verdicts& verdicts) {
        const Kernel kernel;
        for (std::size_t i = 0; i < given->size(); ++i)
            verdicts[i] = static_cast<signed char>(answer<Kernel, Question>(kernel, (*given)[i]));
    };
}

template <class Kernel>
asker asker_of(question question, std::span<const test::triangle_pair> pairs) {
    constexpr std::array each{
        asker_of<Kernel, question::orient2d>,         asker_of<Kernel, question::orient3d>,
        asker_of<Kernel, question::collinear>,        asker_of<Kernel, question::compare_along>,
        asker_of<Kernel, question::compare_distance>, asker_of<Kernel, question::triangles_meet>};
    return each[static_cast<std::size_t>(question)](pairs);
}

}  // namespace

asker cgal_filtered(question question, std::span<const test::triangle_pair> pairs) {
    return asker_of<CGAL::Exact_predicates_inexact_constructions_kernel>(question, pairs);
}

asker cgal_exact(question question, std::span<const test::triangle_pair> pairs) {
    return asker_of<CGAL::Exact_predicates_exact_constructions_kernel>(question, pairs);
}

}  // namespace treeform::bench
