#include "bench/crowds.hpp"

#include <treeform/mesh/weld.hpp>

#include <support/random.hpp>
#include <support/solids.hpp>
#include <support/soups.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace treeform::bench {
namespace {

constexpr double pi = std::numbers::pi;

std::uint32_t number(std::size_t i) { return static_cast<std::uint32_t>(i); }

/// Rings of corners from pole to pole.
mesh sphere(double radius, poles poles) {
    constexpr std::size_t about = 24, along = 21;
    mesh result;
    const bool joined = poles == poles::joined;
    for (std::size_t i = 0; i <= along; ++i) {
        const bool is_pole = i == 0 || i == along;
        for (std::size_t j = 0; j < about; ++j) {
            const double polar = pi * static_cast<double>(i) / along;
            const double turn = 2 * pi * (static_cast<double>(j) + 0.3) / about;
            const double out = radius * (is_pole && joined ? 0.0 : std::sin(polar));
            result.points.push_back(
                {out * std::cos(turn), out * std::sin(turn), radius * std::cos(polar)});
        }
    }
    for (std::size_t i = 0; i < along; ++i)
        for (std::size_t j = 0; j < about; ++j) {
            const std::size_t k = (j + 1) % about;
            const std::uint32_t a = number(i * about + j), b = number(i * about + k),
                                c = number((i + 1) * about + j), d = number((i + 1) * about + k);
            if (i > 0) result.faces.push_back({a, c, b});
            if (i + 1 < along) result.faces.push_back({b, c, d});
        }
    return joined ? join_equal_points(result) : result;
}

mesh turned_at_random(mesh solid, test::random& source) {
    const double up = source.in(-1, 1), turn = source.in(0, 2 * pi);
    const double flat = std::sqrt(1 - up * up);
    return test::turned(std::move(solid), {flat * std::cos(turn), flat * std::sin(turn), up},
                        source.in(0, 2 * pi));
}

point3 somewhere(test::random& source, double side) {
    return {source.in(0, side), source.in(0, side), source.in(0, side)};
}

/// With its box about the origin, of size 1 at most.
mesh centered(mesh solid) {
    const box3 box = bounding_box(solid.points).value();
    point3 middle;
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = -0.5 * (box.min[k] + box.max[k]);
        size = std::max(size, box.max[k] - box.min[k]);
    }
    return test::scaled(test::moved(std::move(solid), middle), 1.0 / size);
}

/// A tube around the trefoil that runs twice about the axis of a torus and three times about its
/// ring.
mesh torus_knot() {
    constexpr std::size_t along = 20, about = 25;
    constexpr double thickness = 0.9;
    const auto at = [](double t) {
        const double out = 2 + std::cos(3 * t);
        return point3{out * std::cos(2 * t), out * std::sin(2 * t), std::sin(3 * t)};
    };
    mesh result;
    for (std::size_t i = 0; i < along; ++i) {
        const double t = 2 * pi * static_cast<double>(i) / along;
        const point3 p = at(t), q = at(t + 1e-3);
        const point3 way{q.x - p.x, q.y - p.y, q.z - p.z};
        const double length = std::hypot(way.x, way.y, way.z);
        // Along the ring's radius, made square to the way; then square to both.
        point3 u{std::cos(2 * t) * std::cos(3 * t), std::sin(2 * t) * std::cos(3 * t),
                 std::sin(3 * t)};
        const double share = (u.x * way.x + u.y * way.y + u.z * way.z) / (length * length);
        u = {u.x - share * way.x, u.y - share * way.y, u.z - share * way.z};
        const double size = std::hypot(u.x, u.y, u.z);
        u = {u.x / size, u.y / size, u.z / size};
        const point3 v{(way.y * u.z - way.z * u.y) / length, (way.z * u.x - way.x * u.z) / length,
                       (way.x * u.y - way.y * u.x) / length};
        for (std::size_t j = 0; j < about; ++j) {
            const double turn = 2 * pi * static_cast<double>(j) / about;
            const double c = thickness * std::cos(turn), s = thickness * std::sin(turn);
            result.points.push_back(
                {p.x + c * u.x + s * v.x, p.y + c * u.y + s * v.y, p.z + c * u.z + s * v.z});
        }
    }
    for (std::size_t i = 0; i < along; ++i)
        for (std::size_t j = 0; j < about; ++j) {
            const auto corner = [&](std::size_t k, std::size_t l) {
                return number((k % along) * about + l % about);
            };
            const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                d = corner(i, j + 1);
            result.faces.push_back({a, c, b});
            result.faces.push_back({a, d, c});
        }
    return result;
}

}  // namespace

crowd crowd_of(std::function<meshes()> make) {
    return [make = std::move(make), last = std::make_shared<std::weak_ptr<const meshes>>()] {
        std::shared_ptr<const meshes> made = last->lock();
        if (!made) *last = made = std::make_shared<const meshes>(make());
        return made;
    };
}

meshes spheres(std::size_t count, poles poles) {
    test::random source(1);
    meshes result;
    for (std::size_t i = 0; i < count; ++i) {
        mesh ball = sphere(source.in(0.5, 1.0), poles);
        result.push_back(test::moved(std::move(ball), somewhere(source, 4)));
    }
    return result;
}

meshes copies(const meshes& models, std::size_t count) {
    test::random source(2);
    meshes result;
    for (std::size_t i = 0; i < count; ++i) {
        mesh solid = test::scaled(centered(models[i % models.size()]), source.in(1.0, 2.0));
        solid = test::moved(turned_at_random(std::move(solid), source), somewhere(source, 4));
        result.push_back(i % 10 == 9 ? test::inside_out(std::move(solid)) : std::move(solid));
    }
    return result;
}

meshes torus_knots(std::size_t count) {
    test::random source(3);
    meshes result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(turned_at_random(torus_knot(), source));
    return result;
}

meshes plate_and_cylinders(std::size_t side) {
    const auto length = static_cast<double>(side);
    meshes result{test::box(length, length, 0.5)};
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < side; ++j)
            result.push_back(
                test::moved(test::prism(64, 0.3, 1.0),
                            {static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5, -0.25}));
    return result;
}

meshes touching_cubes(std::size_t x, std::size_t y, std::size_t z) {
    meshes result;
    for (std::size_t i = 0; i < x; ++i)
        for (std::size_t j = 0; j < y; ++j)
            for (std::size_t k = 0; k < z; ++k)
                result.push_back(test::moved(
                    test::box(1, 1, 1),
                    {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
    return result;
}

meshes random_cubes(std::size_t count) {
    test::random source(4);
    meshes result;
    for (std::size_t i = 0; i < count; ++i) {
        const double side = source.in(0.03, 0.1);
        mesh cube = turned_at_random(test::box(side, side, side), source);
        result.push_back(test::moved(std::move(cube), somewhere(source, 1)));
    }
    return result;
}

mesh in_one_mesh(const meshes& solids) {
    mesh all;
    for (const mesh& solid : solids) {
        const std::uint32_t offset = number(all.points.size());
        all.points.insert(all.points.end(), solid.points.begin(), solid.points.end());
        for (const auto& [a, b, c] : solid.faces)
            all.faces.push_back({a + offset, b + offset, c + offset});
    }
    return all;
}

}  // namespace treeform::bench
