#pragma once
/// \file
/// Closed meshes of simple shape, outward.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace test {

/// A prism along the third axis, from 0 up, over a regular polygon.
inline tf::mesh prism(std::uint32_t sides, double radius, double height) {
    tf::mesh result;
    for (const double z : {0.0, height})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double turn = 2 * std::numbers::pi * i / sides;
            result.points.push_back({radius * std::cos(turn), radius * std::sin(turn), z});
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = i, b = (i + 1) % sides;
        result.faces.push_back({a, b, b + sides});
        result.faces.push_back({a, b + sides, a + sides});
        if (i == 0 || i + 1 == sides) continue;
        result.faces.push_back({0, b, a});
        result.faces.push_back({sides, a + sides, b + sides});
    }
    return result;
}

/// The box [0, x] x [0, y] x [0, z].
inline tf::mesh box(double x, double y, double z) {
    tf::mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back(
            {(i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0});
    mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A box with corners on a small lattice: of several, all sorts of contact.
inline tf::mesh lattice_box(random& source) {
    const auto whole = [&](std::size_t n) { return static_cast<double>(source.below(n)); };
    tf::mesh mesh = box(1 + whole(3), 1 + whole(3), 1 + whole(3));
    const tf::point3 by{whole(4), whole(4), whole(4)};
    for (tf::point3& p : mesh.points) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return mesh;
}

/// An octahedron, each face cut in four `levels` times, its corners pushed out to `radius`.
inline tf::mesh ball(int levels, double radius) {
    tf::mesh mesh;
    mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, added] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
            if (added) {
                const tf::point3 p = mesh.points[a], q = mesh.points[b];
                mesh.points.push_back({p.x + q.x, p.y + q.y, p.z + q.z});
            }
            return at->second;
        };
        std::vector<tf::face> faces;
        for (const auto& [a, b, c] : mesh.faces) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.faces = std::move(faces);
    }
    for (tf::point3& p : mesh.points) {
        const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) / radius;
        p = {p.x / length, p.y / length, p.z / length};
    }
    return mesh;
}

/// All coordinates multiples of 1 / `steps`, so that faces lie on each other; 0: as they are.
inline tf::mesh on_lattice(tf::mesh mesh, double steps) {
    if (steps > 0)
        for (tf::point3& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = std::round(p[k] * steps) / steps;
    return mesh;
}

/// Turned either way.
inline tf::mesh random_tetrahedron(random& source, double size) {
    tf::mesh solid;
    for (int i = 0; i < 4; ++i)
        solid.points.push_back(
            {source.in(-size, size), source.in(-size, size), source.in(-size, size)});
    solid.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
    return solid;
}

}  // namespace test
