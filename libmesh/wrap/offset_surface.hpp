#pragma once
/// \file
/// The surface of all points that are at one distance from a mesh, and the mesh within.

#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <optional>

namespace treeform::detail::wrap {

class offset_surface {
  public:
    /// Refers to `around`.
    /// \throws std::invalid_argument naming the face with a corner out of range or not finite
    offset_surface(mesh_view around, double offset);

    /// A point of the surface that the segment from `from` to `to` gets to first, or none where it
    /// gets to none: some that it touches only just may be missed.
    [[nodiscard]] std::optional<point3> first_on(const point3& from, const point3& to) const;

    /// A point of the surface next to `p`, on the same side of the mesh; none where there is none
    /// to be found.
    [[nodiscard]] std::optional<point3> next_to(const point3& p) const;

    /// Whether a face of the mesh has a point in the tetrahedron, its faces included. Exact.
    ///
    /// \pre orient3d of the corners > 0
    [[nodiscard]] bool meets(const std::array<point3, 4>& tetrahedron) const;

  private:
    [[nodiscard]] point3 at_offset(const point3& p, const point3& nearest) const;

    mesh_view mesh_;
    double offset_;
    nearness::closest_point_query nearest_;
};

}  // namespace treeform::detail::wrap
