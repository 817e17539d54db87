#pragma once
/// \file
/// The surface at a given distance from a mesh, and the mesh itself.

#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <optional>

namespace treeform::detail::wrap {

class offset_surface {
  public:
    /// `around` must outlive the object.
    /// \throws std::invalid_argument naming the face with a corner out of range or not finite
    offset_surface(mesh_view around, double offset);

    /// The first point of the surface on the segment from `from` to `to`; empty if there is none.
    /// Points where the segment only grazes the surface may be missed.
    [[nodiscard]] std::optional<point3> first_on(const point3& from, const point3& to) const;

    /// A point of the surface near `p`, on the same side of the mesh; empty if none is found.
    [[nodiscard]] std::optional<point3> next_to(const point3& p) const;

    /// Whether a face of the mesh meets the closed tetrahedron. Exact.
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
