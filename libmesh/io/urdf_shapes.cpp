#include "urdf_shapes.hpp"

#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/prism.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace treeform::detail::io {
namespace {

constexpr std::uint32_t cylinder_sides = 96;
constexpr int sphere_halvings = 4;
/// Far above the rounding of the few operations that lead to a coordinate (2^-48), far below what
/// anybody measures: with it, a shape is around the true one in the coordinates as rounded.
constexpr double outward = 1.0 + 0x1p-40;

point3 unit(const point3& p) { return base::scaled(p, 1.0 / std::sqrt(base::dot(p, p))); }

mesh icosahedron() {
    const double g = std::numbers::phi;
    mesh made;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g})
            for (const point3& p : {point3{0, s, t}, point3{s, t, 0}, point3{t, 0, s}})
                made.points.push_back(unit(p));
    // Corners are neighbors when they are 2 apart, in units before scaling: cosine 1 / sqrt(5).
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return base::dot(made.points[a], made.points[b]) > 0.4;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
                const auto &p = made.points[a], &q = made.points[b], &r = made.points[c];
                const bool outside = base::dot(p, base::cross(q, r)) > 0.0;
                made.faces.push_back(outside ? face{a, b, c} : face{a, c, b});
            }
    return made;
}

/// Each face into four, new corners on the unit sphere.
mesh halved(mesh of) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, added] =
            middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(of.points.size()));
        if (added) of.points.push_back(unit(base::plus(of.points[a], of.points[b])));
        return at->second;
    };
    std::vector<face> faces;
    for (const auto& [a, b, c] : of.faces) {
        const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
        faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    of.faces = std::move(faces);
    return of;
}

}  // namespace

mesh box_shape(const std::array<double, 3>& size) {
    mesh made;
    for (const double z : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
            for (const double x : {-0.5, 0.5})
                made.points.push_back({x * size[0], y * size[1], z * size[2]});
    made.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return made;
}

mesh cylinder_shape(double radius, double length) {
    const double out = radius / std::cos(std::numbers::pi / cylinder_sides) * outward;
    return geometry::prism({{{0, 0, -0.5 * length}, {0, 0, 0.5 * length}}},
                           {{{1, 0, 0}, {0, 1, 0}}}, out, cylinder_sides);
}

mesh sphere_shape(double radius) {
    mesh made = icosahedron();
    for (int i = 0; i < sphere_halvings; ++i) made = halved(std::move(made));
    double least = 1.0;  // distance of a face's plane from the center
    for (const auto& [a, b, c] : made.faces) {
        const point3& p = made.points[a];
        const point3 normal =
            unit(base::cross(base::minus(made.points[b], p), base::minus(made.points[c], p)));
        least = std::min(least, base::dot(normal, p));
    }
    const double out = radius / least * outward;
    for (point3& p : made.points) p = base::scaled(p, out);
    return made;
}

}  // namespace treeform::detail::io
