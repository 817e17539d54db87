#pragma once
/// \file
/// Rings and tubes.

#include <treeform/mesh/mesh.hpp>

#include <cmath>
#include <cstdint>

namespace test {

/// A tube about the z axis, standing on z = 0, whose rims have that many corners.
inline treeform::mesh tube(double outer, double inner, double height, std::uint32_t corners) {
    treeform::mesh mesh;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * i / corners;
        const double c = std::cos(angle), s = std::sin(angle);
        mesh.points.insert(mesh.points.end(), {{outer * c, outer * s, 0},
                                               {outer * c, outer * s, height},
                                               {inner * c, inner * s, height},
                                               {inner * c, inner * s, 0}});
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t j = (i + 1) % corners, l = (k + 1) % 4;
            mesh.faces.push_back({4 * i + k, 4 * j + k, 4 * j + l});
            mesh.faces.push_back({4 * i + k, 4 * j + l, 4 * i + l});
        }
    }
    return mesh;
}

}  // namespace test
