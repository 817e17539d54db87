#pragma once
/// \file
/// The winding number of a surface just beside a face.

#include <libmesh/arrange/corner_line.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::detail::arrange {

/// A box around the part of a line that leaves a face in one direction.
[[nodiscard]] inline aabb<double, 3> way_along(const corner_line& line, bool ahead) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    aabb<double, 3> way = line.start();
    (ahead ? way.max : way.min)[static_cast<std::size_t>(line.along())] =
        ahead ? infinite : -infinite;
    return way;
}

/// Calls `visit(i, change)` for the faces that a line crosses on its way from a face of an
/// arrangement, with the winding number before the crossing minus that after it; exact.
///
/// \param index   a tree over the faces of a surface; `corners(i)` returns the corners of primitive
///        i
/// \param way     `way_along(line, ahead)`
template <class Corners, class Visit>
void visit_beside(const tree<3>& index, const Corners& corners, const corner_line& line,
                  const aabb<double, 3>& way, bool ahead, const Visit& visit) {
    const int sign = ahead ? 1 : -1;
    search(index, way, [&](std::uint32_t i) {
        const triangle3 t = corners(i);
        if (const int facing = line.passes(t); facing != 0 && line.place(t, facing) == sign)
            visit(i, sign * facing);
    });
}

/// The winding number of a closed surface just beside a face of an arrangement, on the side on
/// which `line` through it is followed.
template <class Corners>
[[nodiscard]] std::int64_t winding_beside(const tree<3>& index, const Corners& corners,
                                          const corner_line& line, const aabb<double, 3>& way,
                                          bool ahead) {
    std::int64_t winding = 0;
    visit_beside(index, corners, line, way, ahead,
                 [&](std::uint32_t, int change) { winding += change; });
    return winding;
}

}  // namespace treeform::detail::arrange
