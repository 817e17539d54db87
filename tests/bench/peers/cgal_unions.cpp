#include "bench/peers/cgal_unions.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

namespace treeform::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using surface = CGAL::Surface_mesh<kernel::Point_3>;

surface converted(const mesh& mesh) {
    std::vector<kernel::Point_3> points;
    for (const point3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
    std::vector<std::array<std::size_t, 3>> polygons;
    for (const face& f : mesh.faces) polygons.push_back({f[0], f[1], f[2]});
    surface result;
    PMP::polygon_soup_to_polygon_mesh(points, polygons, result);
    return result;
}

/// The number of faces of the union.
std::optional<std::size_t> united(std::vector<surface> parts) {
    while (parts.size() > 1) {
        std::vector<surface> next;
        for (std::size_t i = 0; i + 1 < parts.size(); i += 2) {
            surface both;
            if (!PMP::corefine_and_compute_union(parts[i], parts[i + 1], both)) return {};
            both.collect_garbage();
            next.push_back(std::move(both));
        }
        if (parts.size() % 2 == 1) next.push_back(std::move(parts.back()));
        parts = std::move(next);
    }
    return parts.empty() ? 0 : parts.front().number_of_faces();
}

}  // namespace

job cgal_unions(const std::vector<mesh>& solids) {
    const auto parts = std::make_shared<std::vector<surface>>();
    for (const mesh& solid : solids) parts->push_back(converted(solid));
    using answer = std::optional<std::size_t>;
    return make_job(
        [parts]() -> answer {
            try {
                return united(*parts);
            } catch (const std::exception&) {
                return {};
            }
        },
        [](const answer& faces) -> std::optional<double> { return faces ? 0.0 : 1.0; },
        [](const answer& faces) {
            return std::vector<figure>{{"faces", static_cast<double>(faces.value_or(0))}};
        });
}

}  // namespace treeform::bench
