#include <libmesh/base/point_math.hpp>
#include <libmesh/offset/moved_surface.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform::detail::offset {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::plus;
using base::scaled;

constexpr double most_stretch = 2.0;  ///< of a vertex at a fold, times the distance

void require_agreement(const mesh& surface) {
    struct run {
        std::uint32_t from, to, face;
        auto operator<=>(const run&) const = default;
    };
    std::vector<run> runs;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const auto& [a, b, c] = surface.faces[f];
        if (a == b || b == c || c == a) continue;
        runs.insert(runs.end(), {{a, b, f}, {b, c, f}, {c, a, f}});
    }
    std::sort(runs.begin(), runs.end());
    const auto twice = std::adjacent_find(runs.begin(), runs.end(), [](const run& x, const run& y) {
        return x.from == y.from && x.to == y.to;
    });
    if (twice == runs.end()) return;
    throw std::invalid_argument("treeform::thicken: faces " + std::to_string(twice->face) +
                                " and " + std::to_string((twice + 1)->face) +
                                " are inconsistently oriented, so the surface has no front; "
                                "thicken it to both sides, or orient its faces first");
}

point3 normalized(const point3& v) {
    const double length = std::sqrt(dot(v, v));
    return length > 0.0 ? scaled(v, 1.0 / length) : point3{};
}

}  // namespace

mesh moved_to_front(mesh_view surface, double by) {
    mesh moved = join_equal_points(surface);
    require_agreement(moved);
    std::vector<point3> normals(moved.points.size());
    std::vector<double> angles(moved.points.size(), 0.0);
    for (const face& f : moved.faces) {
        const std::array<point3, 3> t = base::triangle_of(moved.points, f);
        const point3 normal = normalized(cross(minus(t[1], t[0]), minus(t[2], t[0])));
        if (normal == point3{}) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const point3 u = minus(t[(k + 1) % 3], t[k]), v = minus(t[(k + 2) % 3], t[k]);
            const point3 across = cross(u, v);
            const double angle = std::atan2(std::sqrt(dot(across, across)), dot(u, v));
            normals[f[k]] = plus(normals[f[k]], scaled(normal, angle));
            angles[f[k]] += angle;
        }
    }
    for (std::size_t v = 0; v < moved.points.size(); ++v) {
        const double length = std::sqrt(dot(normals[v], normals[v]));
        if (!(length > 0.0)) continue;
        // The mean of the cosines between the mean normal and those of the faces is its length.
        const double stretch = std::min(angles[v] / length, most_stretch);
        moved.points[v] = plus(moved.points[v], scaled(normals[v], by * stretch / length));
    }
    return moved;
}

}  // namespace treeform::detail::offset
