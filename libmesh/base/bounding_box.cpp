#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
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

}  // namespace treeform
