#include "bench/peers/cgal_exact_corefinement.hpp"

#include "bench/peers/exact_number.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <support/rational_points.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace treeform::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using exact = CGAL::Exact_predicates_exact_constructions_kernel;
template <class Kernel>
using surface_of = CGAL::Surface_mesh<typename Kernel::Point_3>;

template <class Kernel>
surface_of<Kernel> convert(const mesh& given) {
    std::vector<typename Kernel::Point_3> points;
    for (const point3& p : given.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const face& f : given.faces)
        if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) polygons.push_back({f[0], f[1], f[2]});
    if (!PMP::is_polygon_soup_a_polygon_mesh(polygons)) PMP::orient_polygon_soup(points, polygons);
    surface_of<Kernel> result;
    PMP::polygon_soup_to_polygon_mesh(points, polygons, result);
    return result;
}

template <class Surface>
mesh rounded(const Surface& surface) {
    mesh result;
    std::vector<std::uint32_t> number(surface.number_of_vertices() +
                                      surface.number_of_removed_vertices());
    for (const auto v : surface.vertices()) {
        number[v.idx()] = static_cast<std::uint32_t>(result.points.size());
        const auto& p = surface.point(v);
        result.points.push_back(
            {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    for (const auto f : surface.faces()) {
        face corners{};
        std::size_t i = 0;
        for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
            corners.at(i++) = number[v.idx()];
        result.faces.push_back(corners);
    }
    return result;
}

template <class Number>
mpq_class rational(const Number& x) {
    return mpq_class(raw_rational(CGAL::exact(x)));
}
mpq_class rational(double x) { return mpq_class(x); }

/// Exact face by face, added up in 1024 bits: the denominators of a sum would grow without end.
template <class Surface>
mpq_class volume_of(const Surface& surface) {
    constexpr mp_bitcnt_t bits = 1024;
    mpf_class sum(0, bits);
    for (const auto f : surface.faces()) {
        std::array<test::rational_point, 3> corners;
        std::size_t i = 0;
        for (const auto v : surface.vertices_around_face(surface.halfedge(f))) {
            const auto& p = surface.point(v);
            corners.at(i++) = {rational(p.x()), rational(p.y()), rational(p.z())};
        }
        sum += mpf_class(test::under(corners[0], corners[1], corners[2]), bits);
    }
    return mpq_class(sum) / 6;
}

template <class Kernel>
class solids final : public cgal_solids {
  public:
    solids(const mesh& a, const mesh& b) : a_(convert<Kernel>(a)), b_(convert<Kernel>(b)) {}

    std::optional<mesh> computed(corefinement operation) const override {
        const auto out = compute(operation);
        return out ? std::optional(rounded(*out)) : std::nullopt;
    }
    std::optional<mpq_class> volume(corefinement operation) const override {
        const auto out = compute(operation);
        return out ? std::optional(volume_of(*out)) : std::nullopt;
    }

  private:
    /// It changes its operands.
    std::optional<surface_of<Kernel>> compute(corefinement operation) const {
        surface_of<Kernel> x = a_, y = b_, out;
        bool done = false;
        switch (operation) {
            case corefinement::set_union:
                done = PMP::corefine_and_compute_union(x, y, out);
                break;
            case corefinement::set_difference:
                done = PMP::corefine_and_compute_difference(x, y, out);
                break;
            case corefinement::set_intersection:
                done = PMP::corefine_and_compute_intersection(x, y, out);
                break;
        }
        return done ? std::optional(std::move(out)) : std::nullopt;
    }

    surface_of<Kernel> a_, b_;
};

}  // namespace

std::shared_ptr<const cgal_solids> cgal_solids_of(const mesh& a, const mesh& b, bool exactly) {
    if (exactly) return std::make_shared<solids<exact>>(a, b);
    return std::make_shared<solids<filtered>>(a, b);
}

std::optional<mesh> cgal_repaired(const mesh& given, cgal_repair how) {
    auto surface = convert<filtered>(given);
    const bool done = how == cgal_repair::autorefine
                          ? PMP::experimental::autorefine_and_remove_self_intersections(surface)
                          : PMP::experimental::remove_self_intersections(surface);
    return done ? std::optional(rounded(surface)) : std::nullopt;
}

}  // namespace treeform::bench
