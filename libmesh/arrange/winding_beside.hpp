#pragma once
/// \file
/// How often a surface winds around what is right beside a face.

#include <libmesh/arrange/corner_line.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::detail::arrange {

/// The part of space through which a line leaves the face that it starts from.
[[nodiscard]] inline aabb<double, 3> way_along(const corner_line& line, bool ahead) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    aabb<double, 3> way = line.start();
    (ahead ? way.max : way.min)[static_cast<std::size_t>(line.along())] =
        ahead ? infinite : -infinite;
    return way;
}

/// Calls `visit(i, change)` for the faces that a line passes on its way from a face of an
/// arrangement, with how often more the surface winds around what is before them than behind,
/// exactly.
///
/// \param index   over the faces of a surface; `corners(i)` are those of what it calls i
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

/// How often a closed surface winds around all that is right beside a face of an arrangement, on
/// the side where `line` through it is followed.
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
