#pragma once
/// \file
/// Parts whose boxes overlap and that do not meet: rings in each other, L shapes, chains.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <support/solids.hpp>
#include <support/soups.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace test {

inline std::vector<tf::prepared_mesh> prepared(const std::vector<tf::mesh>& parts) {
    std::vector<tf::prepared_mesh> all;
    for (const tf::mesh& part : parts) all.emplace_back(tf::mesh(part));
    return all;
}

/// A torus about the z axis: `around` sections of `section` corners each.
inline tf::mesh ring(double radius, double thickness, std::uint32_t around, std::uint32_t section) {
    tf::mesh mesh;
    const auto turn = [](std::uint32_t i, std::uint32_t of) {
        return 2.0 * std::numbers::pi * i / of;
    };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < section; ++j) {
            const double r = radius + thickness * std::cos(turn(j, section));
            mesh.points.push_back({r * std::cos(turn(i, around)), r * std::sin(turn(i, around)),
                                   thickness * std::sin(turn(j, section))});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return (i % around) * section + j % section;
    };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < section; ++j) {
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

/// Links that go through each other, every second one upright; none meets another.
inline std::vector<tf::mesh> chain(std::size_t links) {
    std::vector<tf::mesh> parts;
    for (std::size_t i = 0; i < links; ++i) {
        tf::mesh link = ring(1.0, 0.2, 24, 10);
        if (i % 2 == 1) link = turned(link, {1, 0, 0}, 0.5 * std::numbers::pi);
        parts.push_back(moved(link, {1.3 * static_cast<double>(i), 0, 0}));
    }
    return parts;
}

/// The outline of an L of these lengths, one thick and one high, as one closed surface.
inline tf::mesh l_bracket(double x, double y) {
    tf::mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const tf::point3& p :
             {tf::point3{0, 0, z}, {x, 0, z}, {x, 1, z}, {1, 1, z}, {1, y, z}, {0, y, z}})
            mesh.points.push_back(p);
    mesh.faces = {{0, 3, 1}, {1, 3, 2}, {0, 5, 3},  {3, 5, 4},
                  {6, 7, 9}, {7, 8, 9}, {6, 9, 11}, {9, 10, 11}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.faces.push_back({i, j, j + 6});
        mesh.faces.push_back({i, j + 6, i + 6});
    }
    return mesh;
}

}  // namespace test
