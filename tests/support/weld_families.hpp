#pragma once
/// \file
/// Clouds that are hard to weld.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace test {

inline double unit_number(std::mt19937_64& engine) {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
}

inline tf::point3 unit_point(std::mt19937_64& engine) {
    const double x = unit_number(engine);
    const double y = unit_number(engine);
    return {x, y, unit_number(engine)};
}

struct weld_family {
    const char* name;
    std::vector<tf::point3> points;
    double tolerance;
};

inline tf::point3 moved_by(const tf::point3& p, double by, std::mt19937_64& engine) {
    return {p.x + by * (unit_number(engine) - 0.5), p.y + by * (unit_number(engine) - 0.5),
            p.z + by * (unit_number(engine) - 0.5)};
}

/// `count` points each of what windows, cells and dense places find hard.
inline std::vector<weld_family> weld_families(std::uint64_t seed, std::size_t count) {
    std::mt19937_64 engine(seed);
    const auto filled = [&](const auto& make) {
        std::vector<tf::point3> points;
        while (points.size() < count) points.push_back(make(points));
        return points;
    };
    const auto any_of = [&](const std::vector<tf::point3>& points) {
        return points[engine() % points.size()];
    };
    const auto uniform = [&](const auto&) { return unit_point(engine); };
    const auto copies = [&](double by) {
        return filled([&](const std::vector<tf::point3>& points) {
            return points.empty() || engine() % 2 == 0 ? unit_point(engine)
                                                       : moved_by(any_of(points), by, engine);
        });
    };
    const auto soup = filled([&](const std::vector<tf::point3>& points) {
        return points.size() < 30 || engine() % 6 == 0 ? unit_point(engine) : any_of(points);
    });
    const auto clustered = filled([&](const std::vector<tf::point3>& points) {
        return points.size() < 5 ? unit_point(engine)
                                 : moved_by(points[engine() % 5], 1e-6, engine);
    });
    const auto line = filled([&](const std::vector<tf::point3>& points) {
        return tf::point3{static_cast<double>(points.size() * 37 % 211), 0, 0};
    });
    const auto plane = filled([&](const auto&) {  // one place along the line windows are sorted by
        const double u = unit_number(engine), v = unit_number(engine);
        return tf::point3{0.621 * u, -0.537 * u + 0.570 * v, -0.621 * v};
    });
    const auto grid = filled([&](const auto&) {
        const auto at = [&] { return static_cast<double>(engine() % 9); };
        const double x = at(), y = at();
        return tf::point3{x, y, at()};
    });
    const auto two_balls = filled([&](const std::vector<tf::point3>& points) {
        return moved_by({points.size() % 2 == 0 ? 0.0 : 1.0, 0, 0}, 0.02, engine);
    });
    auto outliers = copies(1e-3);
    outliers[0] = {1e300, 0, 0};
    outliers[7] = {-1e300, 1e-300, 5e17};
    auto mixed = filled([&](const auto&) {
        const tf::point3 p = unit_point(engine);
        const double scale = std::ldexp(1.0, static_cast<int>(engine() % 40) - 20);
        return tf::point3{p.x * scale, p.y * scale, p.z * scale};
    });
    return {{"uniform", filled(uniform), 0.02},
            {"moved copies", copies(1e-3), 1e-3},
            {"moved copies, half within", copies(2e-3), 1e-3},
            {"copies", copies(0.0), 1e-3},
            {"copies, tiny tolerance", copies(0.0), 1e-18},
            {"soup", soup, 0.1},
            {"soup, all neighbors", soup, 0.7},
            {"clusters", clustered, 1e-3},
            {"clusters, dissolved", clustered, 1e-7},
            {"line", line, 1.0},
            {"plane", plane, 0.02},
            {"grid", grid, 1.0},
            {"grid, diagonals", grid, std::sqrt(2.0)},
            {"balls at the tolerance", two_balls, 0.985},
            {"outliers", outliers, 1e-3},
            {"mixed scales", mixed, 1e-3},
            {"larger than the box", filled(uniform), 5.0},
            {"all equal", std::vector<tf::point3>(count, {1, 2, 3}), 0.5},
            {"all equal, exactly", std::vector<tf::point3>(count, {1, 2, 3}), 0.0}};
}

}  // namespace test
