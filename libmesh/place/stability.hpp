#pragma once
/// \file
/// How firmly a mesh stands on the sides of its convex hull.

#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct mass_center {
    point3 at{};
    int dimension = 3;  ///< as in `laid_flat`
};

/// The center of mass; `ids` are the points that count of a mesh without faces. Of a closed mesh it
/// does not depend on which way the faces look. One that encloses next to nothing, as two sheets
/// back to back do, counts as its surface.
///
/// \pre  what is counted is not empty
/// \cost O(F); rounded
[[nodiscard]] mass_center center_of_mass(mesh_view mesh, std::span<const std::uint32_t> ids);

/// How high `center` is over each side of the hull of `points`.
[[nodiscard]] std::vector<double> heights_over_sides(const convex_hull_result& hull,
                                                     const point3& center);

/// The tilt at which what has this center of mass, at these heights, tips over on each side.
[[nodiscard]] std::vector<double> tip_angles(points_view points, const convex_hull_result& hull,
                                             const point3& center, std::span<const double> heights);

/// Area of the faces that look down by more than that, if the side is on the bed, and are not on
/// it.
[[nodiscard]] double overhang_of(mesh_view mesh, const hull_side& side, double angle,
                                 double tolerance);

}  // namespace treeform::detail::place
