#pragma once
/// \file
/// Whether points are inside, outside or on a closed mesh; the same for closed curves in the plane.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// The position of a point relative to a surface or curve.
enum class location : std::uint8_t { outside, inside, boundary };
template <>
inline constexpr auto detail::names_of<location> = std::array{"outside", "inside", "boundary"};

/// The result of `locate`.
struct point_location {
    location where = location::outside;
    /// How often the surface or curve winds around the point; a mesh with outward faces, or a
    /// counter-clockwise curve, counts +1. 0 is outside, anything else inside. 0 on the boundary,
    /// where the winding number is undefined.
    std::int32_t winding = 0;
    /// On the boundary, the lowest face or edge that contains the point; else 0.
    std::uint32_t on = 0;
    friend bool operator==(const point_location&, const point_location&) = default;
};

/// An open edge of the mesh, as its lower and higher point number: the lowest edge whose signed
/// face count is not zero. None if the mesh is closed; then winding numbers are defined. A closed
/// mesh may consist of parts, be nonmanifold, and intersect itself. Faces that repeat a corner are
/// ignored. Corners are compared by number: join equal ones first (`join_equal_points`).
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(V + F log d) time for at most d faces at a point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<std::array<std::uint32_t, 2>> find_open_edge(
    mesh_view mesh);

/// The number (from 0) of the first of `tolerances` that closes `mesh` if points are joined as by
/// `usable_faces`: at least one face with three corners is left, and no edge is open. None if
/// joining equal points already closes the mesh, or if no tolerance does.
///
/// \pre    the coordinates of corners are finite
/// \throws std::invalid_argument as `usable_faces`
/// \cost   as `usable_faces` for each tolerance that is tried, and a copy of the mesh
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<std::size_t> closing_tolerance(
    mesh_view mesh, std::span<const double> tolerances);

/// The position of a point relative to a closed mesh.
///
/// Exact on the coordinates as given, for every point. The crossings of one ray along x are
/// counted. An edge that the ray grazes is treated as lying to one side, by a rule that all faces
/// share, so no second ray is needed. Points with equal coordinates are one vertex.
///
/// \throws std::invalid_argument if the mesh is open, naming an open edge (`find_open_edge`);
///         naming a face with a corner out of range or not finite, or a point that is not finite
/// \cost   O(F log F) for the indexes, which a prepared mesh keeps; O(log F + B) a point, for the B
///         faces whose boxes meet the ray from the point along +x
/// \same   on any number of threads
/// \source the half-open rule is the simulation of a ray moved by (0, eps, eps^2): Edelsbrunner and
///         Muecke, Simulation of Simplicity, ACM TOG 9 (1990)
[[nodiscard]] TREEFORM_API point_location locate(const mesh_ref& mesh, const point3& point);

/// [P] The same for many points in parallel; answers in the order of the points.
[[nodiscard]] TREEFORM_API std::vector<point_location> locate(const mesh_ref& mesh,
                                                              std::span<const point3> points);

/// Whether the point is inside the closed mesh or on its surface: inside is where the winding
/// number is not 0 (`fill_rule::nonzero`). For errors and cost, see `locate`.
[[nodiscard]] TREEFORM_API bool contains(const mesh_ref& mesh, const point3& point);

/// The winding number of the surface around the point; 0 on the surface. Errors and cost: see
/// `locate`.
[[nodiscard]] TREEFORM_API int winding_number(const mesh_ref& mesh, const point3& point);

/// An edge of a curve, from one point to another. The inside of a simple curve is on its left.
using curve_edge = std::array<std::uint32_t, 2>;

/// Locates points with respect to closed curves in the plane: any number of curves, even crossing
/// or repeated ones. Exact, like `locate`.
class TREEFORM_API curve_locator {
  public:
    /// Curves of `points` [V] and `edges` [E]; both must outlive the locator.
    ///
    /// \throws std::invalid_argument naming the lowest point where a curve is open (the numbers of
    ///         edges to it and from it differ), or an edge with an end out of range or not finite
    /// \cost   a tree over the edges
    curve_locator(std::span<const point2> points, std::span<const curve_edge> edges);

    /// \throws std::invalid_argument if a coordinate is not finite; so does the overload below
    /// \cost   O(log E + B) for the B edges whose boxes meet the ray from the point along +x
    [[nodiscard]] point_location locate(const point2& point) const;

    /// [P] The same for many points; answers in the order of the points.
    /// \same on any number of threads
    [[nodiscard]] std::vector<point_location> locate(std::span<const point2> points) const;

  private:
    std::span<const point2> points_;
    std::span<const curve_edge> edges_;
    tree<2> tree_;
};

}  // namespace treeform
