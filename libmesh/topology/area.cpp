#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/topology/area.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/parallel.hpp>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace treeform::detail::topology {

double area(mesh_view mesh) {
    std::vector<double> parts(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(mesh.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t c) {
                   for (std::size_t f = begin; f < end; ++f) {
                       const auto [p, q, r] = base::triangle_of(mesh.points, mesh.faces[f]);
                       const point3 normal = base::cross(base::minus(q, p), base::minus(r, p));
                       parts[c] += std::hypot(normal.x, normal.y, normal.z) / 2.0;
                   }
               });
    return std::accumulate(parts.begin(), parts.end(), 0.0);
}

}  // namespace treeform::detail::topology

namespace treeform {

double surface_area(const mesh_ref& given) {
    const mesh_view mesh = given.view();
    detail::base::check_faces("surface_area", mesh.points.size(), mesh.faces);
    return detail::topology::area(mesh);
}

}  // namespace treeform
