#pragma once
/// \file
/// Scans of a solid whose place is known: points on its surface with noise, turned and shifted.

#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/aabb.hpp>

#include <support/random.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace test {

/// What of the two sides the other one has.
enum class scanned { all, part_of_fixed, part_of_moving };

struct scan_settings {
    std::size_t points = 3000;
    double noise = 0.0;  ///< standard deviation in each coordinate, share of the diagonal
    double degrees =
        10.0;            ///< of the turn; the shift is up to 5% of the diagonal in each direction
    double share = 1.0;  ///< of the part
    scanned what = scanned::all;
    bool from_vertices = false;  ///< points are at vertices, and not spread evenly by area
};

struct scan {
    tf::mesh whole{};                  ///< the solid
    tf::mesh fixed{};                  ///< it, or a part of it
    std::vector<tf::point3> home{};    ///< where the points belong
    std::vector<tf::point3> moving{};  ///< where they are: with noise, moved by `away`
    tf::transform<3> away{};
};

inline tf::point3 direction(random& source) {
    for (;;) {
        const tf::point3 p{source.in(-1, 1), source.in(-1, 1), source.in(-1, 1)};
        const double length = std::hypot(p.x, p.y, p.z);
        if (length > 0.1 && length < 1.0) return {p.x / length, p.y / length, p.z / length};
    }
}

inline double gaussian(random& source) {
    const double r = std::sqrt(-2.0 * std::log(1.0 - source.unit()));
    return r * std::cos(2.0 * std::numbers::pi * source.unit());
}

inline tf::transform<3> turn_about(const tf::point3& axis, double angle, const tf::point3& center,
                                   const tf::point3& shift) {
    const double x = axis.x, y = axis.y, z = axis.z, c = std::cos(angle), s = std::sin(angle);
    tf::transform<3> m;
    m.rows = {{{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s, 0},
               {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s, 0},
               {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c), 0}}};
    const tf::point3 turned = m(center);
    for (std::size_t k = 0; k < 3; ++k) m.rows[k][3] = center[k] - turned[k] + shift[k];
    return m;
}

/// Points on the faces, evenly by area.
inline std::vector<tf::point3> spread_over(random& source, const tf::mesh& mesh,
                                           std::size_t count) {
    std::vector<double> sums;
    double sum = 0.0;
    for (const tf::face& f : mesh.faces) {
        const tf::point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        const tf::point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
        sum += std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        sums.push_back(sum);
    }
    std::vector<tf::point3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = std::upper_bound(sums.begin(), sums.end(), source.in(0, sum));
        const auto number =
            std::min<std::size_t>(static_cast<std::size_t>(at - sums.begin()), sums.size() - 1);
        const tf::face& f = mesh.faces[number];
        const tf::point3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        double u = source.unit(), v = source.unit();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        tf::point3 p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
        points.push_back(p);
    }
    return points;
}

/// How far along `d` a share of the points is, at most.
inline double quantile_along(const std::vector<tf::point3>& points, const tf::point3& d,
                             double share) {
    std::vector<double> along;
    for (const tf::point3& p : points) along.push_back(p.x * d.x + p.y * d.y + p.z * d.z);
    const auto at =
        along.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(along.size() - 1));
    std::nth_element(along.begin(), at, along.end());
    return *at;
}

inline scan scan_of(const tf::mesh& solid, const scan_settings& how, random& source) {
    scan made{.whole = solid, .fixed = solid};
    const tf::box3 box = tf::bounding_box(solid.points).value();
    const double size = box.diagonal();
    made.home = how.from_vertices ? solid.points : spread_over(source, solid, how.points);
    const tf::point3 d = direction(source);
    const double end = quantile_along(made.home, d, how.share);
    const auto beyond = [&](const tf::point3& p) {
        return p.x * d.x + p.y * d.y + p.z * d.z > end;
    };
    if (how.what == scanned::part_of_moving) std::erase_if(made.home, beyond);
    if (how.what == scanned::part_of_fixed)
        std::erase_if(made.fixed.faces, [&](const tf::face& f) {
            tf::point3 center;
            for (const std::uint32_t v : f)
                for (std::size_t k = 0; k < 3; ++k) center[k] += solid.points[v][k] / 3.0;
            return beyond(center);
        });
    const tf::point3 center{0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y),
                            0.5 * (box.min.z + box.max.z)};
    const double reach = 0.05 * size;
    const tf::point3 shift{source.in(-reach, reach), source.in(-reach, reach),
                           source.in(-reach, reach)};
    made.away =
        turn_about(direction(source), how.degrees * std::numbers::pi / 180.0, center, shift);
    for (tf::point3 p : made.home) {
        for (std::size_t k = 0; k < 3; ++k) p[k] += how.noise * size * gaussian(source);
        made.moving.push_back(made.away(p));
    }
    return made;
}

/// Root mean square of how far the points, without their noise, end from where they belong, as a
/// share of the diagonal. Of shapes that turns take to themselves (`symmetric`), how far from the
/// surface.
inline double error_of(const scan& of, const tf::transform<3>& back, bool symmetric) {
    std::vector<tf::point3> ended;
    for (const tf::point3& p : of.home) ended.push_back(back(of.away(p)));
    const auto near = symmetric ? tf::closest_point(of.whole, ended)
                                : std::vector<std::optional<tf::closest_point_result>>{};
    double sum = 0.0;
    for (std::size_t i = 0; i < ended.size(); ++i) {
        const tf::point3 &p = ended[i], &q = symmetric ? near[i]->point : of.home[i];
        sum += (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z);
    }
    return std::sqrt(sum / static_cast<double>(ended.size())) /
           tf::bounding_box(of.whole.points).value().diagonal();
}

}  // namespace test
