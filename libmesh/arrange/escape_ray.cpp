#include <libmesh/arrange/escape_ray.hpp>
#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace treeform::detail::arrange {

escape_ray find_escape_ray(mesh_view mesh, const mesh_arrangement& cut, std::size_t f,
                           const aabb<double, 3>& box) {
    const auto& [a, b, c] = cut.faces[f];
    return find_escape_ray({cut.point(a), cut.point(b), cut.point(c)},
                           base::triangle_of(mesh, cut.covers_of(f).front().face), box);
}

escape_ray find_escape_ray(const std::array<implicit_point, 3>& corners, const triangle3& whole,
                           const aabb<double, 3>& box) {
    const point3 normal =
        base::cross(base::minus(whole[1], whole[0]), base::minus(whole[2], whole[0]));
    const point3 size = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const double steep = 0.25 * std::max({size.x, size.y, size.z});
    const auto ahead = [&](std::size_t k) { return box.max[k] - whole[0][k]; };
    const auto back = [&](std::size_t k) { return whole[0][k] - box.min[k]; };
    const auto cost = [&](int axis) {
        const auto k = static_cast<std::size_t>(axis);
        return std::pair(size[k] < steep, std::min(ahead(k), back(k)));
    };
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::stable_sort(axes, [&](int i, int j) { return cost(i) < cost(j); });
    // Along one of them it is not seen edge on.
    const int axis = *std::ranges::find_if(
        axes, [&](int k) { return orient2d(k, corners[0], corners[1], corners[2]) != 0; });
    const auto k = static_cast<std::size_t>(axis);
    return {{corners, axis}, ahead(k) < back(k)};
}

}  // namespace treeform::detail::arrange
