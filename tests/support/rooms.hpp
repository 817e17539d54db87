#pragma once
/// \file
/// Rooms with one wall between two of them.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace test {

/// x * y * z unit cubes. The square between two of them is there once, and its normal points along
/// the axis; outer squares are outward. Each square is two faces.
inline tf::mesh rooms(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::array<std::uint32_t, 3> n{x, y, z};
    tf::mesh mesh;
    const auto number = [&](const std::array<std::uint32_t, 3>& p) {
        return (p[0] * (y + 1) + p[1]) * (z + 1) + p[2];
    };
    for (std::uint32_t i = 0; i <= x; ++i)
        for (std::uint32_t j = 0; j <= y; ++j)
            for (std::uint32_t k = 0; k <= z; ++k)
                mesh.points.push_back(
                    {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (std::uint32_t at = 0; at <= n[axis]; ++at)
            for (std::uint32_t i = 0; i < n[u]; ++i)
                for (std::uint32_t j = 0; j < n[v]; ++j) {
                    std::array<std::uint32_t, 3> p{};
                    p[axis] = at;
                    std::array<std::uint32_t, 4> corner{};
                    for (std::size_t c = 0; c < 4; ++c) {
                        p[u] = i + (c == 1 || c == 2 ? 1 : 0);
                        p[v] = j + (c >= 2 ? 1 : 0);
                        corner[c] = number(p);
                    }
                    const auto [a, b, c, d] = corner;
                    if (at > 0)
                        mesh.faces.insert(mesh.faces.end(), {{a, b, c}, {a, c, d}});
                    else
                        mesh.faces.insert(mesh.faces.end(), {{a, c, b}, {a, d, c}});
                }
    }
    return mesh;
}

/// Whether a face of `rooms` is not between two of them.
inline bool is_outer(const tf::face& f, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::array<std::uint32_t, 3> n{x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const std::uint32_t at : {0U, n[axis]}) {
            bool is_there = true;
            for (const std::uint32_t p : f) {
                const std::array<std::uint32_t, 3> place{p / (z + 1) / (y + 1),
                                                         p / (z + 1) % (y + 1), p % (z + 1)};
                is_there = is_there && place[axis] == at;
            }
            if (is_there) return true;
        }
    return false;
}

}  // namespace test
