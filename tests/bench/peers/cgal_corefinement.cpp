#include "bench/peers/cgal_corefinement.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <memory>
#include <vector>

namespace treeform::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;

std::shared_ptr<const surface> convert(const mesh& mesh) {
    std::vector<kernel::Point_3> points;
    for (const point3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const face& f : mesh.faces) polygons.push_back({f[0], f[1], f[2]});
    auto result = std::make_shared<surface>();
    PMP::polygon_soup_to_polygon_mesh(points, polygons, *result);
    return result;
}

struct answer {
    surface result;
    bool done = false;
};

}  // namespace

job cgal_corefinement(const mesh& a, const mesh& b, corefinement operation) {
    const auto first = convert(a), second = convert(b);
    return make_job(
        [first, second, operation] {
            surface x = *first, y = *second;
            answer out;
            switch (operation) {
                case corefinement::set_union:
                    out.done = PMP::corefine_and_compute_union(x, y, out.result);
                    break;
                case corefinement::set_difference:
                    out.done = PMP::corefine_and_compute_difference(x, y, out.result);
                    break;
                case corefinement::set_intersection:
                    out.done = PMP::corefine_and_compute_intersection(x, y, out.result);
                    break;
            }
            return out;
        },
        [](const answer& out) -> std::optional<double> { return out.done ? 0.0 : 1.0; },
        [](const answer& out) {
            return std::vector<figure>{
                {"faces", static_cast<double>(out.result.number_of_faces())}};
        });
}

}  // namespace treeform::bench
