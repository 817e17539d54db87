#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace treeform {

std::optional<box3> bounding_box(points_view points) {
    std::optional<box3> box;
    for (const point3& p : points) {
        if (!detail::base::is_finite(p)) continue;
        if (!box) box = box3{p, p};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box->min[axis] = std::min(box->min[axis], p[axis]);
            box->max[axis] = std::max(box->max[axis], p[axis]);
        }
    }
    return box;
}

double box3::diagonal() const {
    const box3& box = *this;
    constexpr double most = std::numeric_limits<double>::max();
    const double x = box.max.x - box.min.x;
    const double y = box.max.y - box.min.y;
    const double z = box.max.z - box.min.z;
    if (std::max({x, y, z}) > most) return most;  // hypot of an infinite length may be NaN
    return std::min(std::hypot(x, y, z), most);
}

treeform::mesh box3::mesh() const {
    treeform::mesh made;
    for (std::size_t corner = 0; corner < 8; ++corner)
        made.points.push_back(
            {(corner & 1 ? max : min).x, (corner & 2 ? max : min).y, (corner & 4 ? max : min).z});
    made.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return made;
}

}  // namespace treeform
