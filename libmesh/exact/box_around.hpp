#pragma once
/// \file
/// Bounding box of an implicit point.

#include <libmesh/exact/implicit_point.hpp>
#include <treeform/tree/aabb.hpp>

#include <cmath>
#include <cstddef>

namespace treeform::detail::exact {

/// The box of all positions within the error bound of `p`, rounded outward.
[[nodiscard]] inline aabb<double, 3> box_around(const implicit_point& p) {
    aabb<double, 3> box;
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = p.center()[k];
        const double off =
            p.radius() > 0.0 ? p.radius() + 0x1p-51 * (std::abs(at) + p.radius()) : 0.0;
        box.min[k] = at - off;
        box.max[k] = at + off;
    }
    return box;
}

}  // namespace treeform::detail::exact
