#pragma once
/// \file
/// The stability of a mesh on the sides of its convex hull.

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

/// The center of mass. For a mesh without faces it is that of the points `ids`. For a closed mesh
/// it does not depend on the orientation of the faces. For a closed mesh with almost no volume,
/// such as two sheets back to back, it is that of the surface.
///
/// \pre  there is a face, or `ids` is not empty
/// \cost O(F); rounded
[[nodiscard]] mass_center center_of_mass(mesh_view mesh, std::span<const std::uint32_t> ids);

/// The height of `center` above each side of `hull`.
[[nodiscard]] std::vector<double> heights_over_sides(const convex_hull_result& hull,
                                                     const point3& center);

/// For each side, the tilt at which a body with this center of mass, at these heights, tips over.
[[nodiscard]] std::vector<double> tip_angles(points_view points, const convex_hull_result& hull,
                                             const point3& center, std::span<const double> heights);

/// Total area of the faces that, with the side on the bed, face down by more than `angle` and are
/// not on the bed.
[[nodiscard]] double overhang_of(mesh_view mesh, const hull_side& side, double angle,
                                 double tolerance);

}  // namespace treeform::detail::place
