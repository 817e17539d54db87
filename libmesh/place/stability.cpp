#include <libmesh/base/point_math.hpp>
#include <libmesh/place/quickhull.hpp>
#include <treeform/mesh/point_location.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace treeform::detail::place {
namespace {

using base::cross;
using base::dot;
using base::minus;
using base::triangle_of;

constexpr double degrees = 180.0 / std::numbers::pi;

/// Sums of weights and of weighted points.
struct moments {
    double weight = 0.0;
    double weight_of_all = 0.0;  ///< magnitudes
    std::array<double, 3> sum{};

    void add(double w, const point3& p) {
        weight += w;
        weight_of_all += std::abs(w);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += w * p[k];
    }
};

point3 middle_of(const std::array<point3, 3>& t, double of) {
    point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = (t[0][k] + t[1][k] + t[2][k]) / of;
    return p;
}

}  // namespace

mass_center center_of_mass(mesh_view mesh, std::span<const std::uint32_t> ids) {
    // In lengths of the box, from its center: no product overflows, and none is lost far away.
    std::vector<point3> used;
    for (const std::uint32_t i : ids) used.push_back(mesh.points[i]);
    const box3 box = *bounding_box(used);
    point3 middle;
    double length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = 0.5 * box.min[k] + 0.5 * box.max[k];
        length = std::max(length, 0.5 * box.max[k] - 0.5 * box.min[k]);
    }
    const double unit = length > 0.0 ? length : 1.0;
    const auto local = [&](const point3& p) { return base::scaled(minus(p, middle), 1.0 / unit); };
    moments solid, surface, points;
    for (const face& f : mesh.faces) {
        std::array<point3, 3> t = triangle_of(mesh.points, f);
        for (point3& p : t) p = local(p);
        const point3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        solid.add(dot(normal, t[0]), middle_of(t, 4.0));
        surface.add(std::sqrt(dot(normal, normal)), middle_of(t, 3.0));
    }
    for (const std::uint32_t i : ids) points.add(1.0, local(mesh.points[i]));
    const auto center = [&](const moments& m, int dimension) {
        point3 at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = middle[k] + unit * (m.sum[k] / m.weight);
        return mass_center{at, dimension};
    };
    if (std::abs(solid.weight) > 0x1p-40 * solid.weight_of_all && !find_open_edge(mesh))
        return center(solid, 3);
    if (surface.weight > 0.0) return center(surface, 2);
    return center(points, 0);
}

std::vector<double> heights_over_sides(const convex_hull_result& hull, const point3& center) {
    std::vector<double> all;
    for (const hull_side& side : hull.sides)
        all.push_back(std::max(0.0, -dot(side.normal, minus(center, side.center))));
    return all;
}

std::vector<double> tip_angles(points_view points, const convex_hull_result& hull,
                               const point3& center, std::span<const double> heights) {
    std::vector<double> all;
    for (const hull_side& side : hull.sides) {
        const point3& n = side.normal;
        const double height = heights[all.size()];
        double least = std::numeric_limits<double>::infinity();
        const std::vector<std::uint32_t> corners = hull.corners_of(side, points);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const point3& from = points[corners[i]];
            const point3 along = minus(points[corners[(i + 1) % corners.size()]], from);
            const double length = std::sqrt(dot(along, along));
            if (!(length > 0.0)) continue;
            // Counter-clockwise seen from outside: the inside is to the left, seen against n.
            const point3 inward = cross(n, along);
            least = std::min(least, dot(inward, minus(center, from)) / length);
        }
        all.push_back(height == 0.0 && least >= 0.0 ? 90.0 : std::atan2(least, height) * degrees);
    }
    return all;
}

double overhang_of(mesh_view mesh, const hull_side& side, double angle, double tolerance) {
    // A face is `angle` from the vertical when its normal is that from the horizontal.
    const double least = std::sin(angle / degrees);
    double area = 0.0;
    for (const face& f : mesh.faces) {
        const auto t = triangle_of(mesh.points, f);
        const point3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        const double length = std::sqrt(dot(normal, normal));
        if (!(dot(normal, side.normal) > least * length * (1.0 + 0x1p-40))) continue;
        const bool down = std::all_of(t.begin(), t.end(), [&](const point3& p) {
            return -dot(side.normal, minus(p, side.center)) <= tolerance;
        });
        if (!down) area += 0.5 * length;
    }
    return area;
}

}  // namespace treeform::detail::place
