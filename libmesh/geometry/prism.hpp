#pragma once
/// \file
/// Regular prisms.

#include <libmesh/base/point_math.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace treeform::detail::geometry {

/// A regular prism with `sides` sides between two points, with corners at a distance of `radius`
/// from the line through them; the first corner is in the direction `across[0]`. Faces are oriented
/// outward.
///
/// \pre the vector between the points and the two unit vectors `across` are a right-handed
///      orthogonal frame
[[nodiscard]] inline mesh prism(const std::array<point3, 2>& ends,
                                const std::array<point3, 2>& across, double radius,
                                std::uint32_t sides) {
    mesh made;
    for (const point3& end : ends)
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / sides;
            const point3 out = base::plus(base::scaled(across[0], std::cos(turn)),
                                          base::scaled(across[1], std::sin(turn)));
            made.points.push_back(base::plus(end, base::scaled(out, radius)));
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t j = (i + 1) % sides;
        made.faces.push_back({i, j, sides + i});
        made.faces.push_back({j, sides + j, sides + i});
        if (i == 0 || j == 0) continue;
        made.faces.push_back({0, j, i});
        made.faces.push_back({sides, sides + i, sides + j});
    }
    return made;
}

}  // namespace treeform::detail::geometry
