#include <libmesh/base/point_math.hpp>
#include <libmesh/topology/area.hpp>

#include <cmath>

namespace treeform::detail::topology {

double area(mesh_view mesh) {
    double sum = 0.0;
    for (const face& f : mesh.faces) {
        const auto [a, b, c] = base::triangle_of(mesh.points, f);
        const point3 normal = base::cross(base::minus(b, a), base::minus(c, a));
        sum += std::hypot(normal.x, normal.y, normal.z) / 2.0;
    }
    return sum;
}

}  // namespace treeform::detail::topology
