#include "bench/peers/cgal_merge_points.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <cmath>
#include <memory>
#include <vector>

namespace treeform::bench {
namespace {

struct soup {
    std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
};

}  // namespace

job cgal_merge_points(const mesh& mesh, std::size_t distinct) {
    const auto given = std::make_shared<soup>();
    for (const point3& p : mesh.points) given->points.emplace_back(p.x, p.y, p.z);
    for (const face& f : mesh.faces) given->polygons.push_back({f[0], f[1], f[2]});
    const auto merged = std::make_shared<soup>(*given);
    return {.run =
                [merged] {
                    CGAL::Polygon_mesh_processing::merge_duplicate_points_in_polygon_soup(
                        merged->points, merged->polygons);
                },
            .discard = [given, merged] { *merged = *given; },
            .error = [merged, distinct]() -> std::optional<double> {
                return std::abs(static_cast<double>(merged->points.size()) -
                                static_cast<double>(distinct));
            }};
}

}  // namespace treeform::bench
