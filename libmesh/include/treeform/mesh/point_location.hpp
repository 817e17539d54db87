#pragma once
/// \file
/// Inside, outside or on: points against a closed mesh, and against closed curves of the plane.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/tree.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

enum class location : std::uint8_t { outside, inside, boundary };

struct point_location {
    location where = location::outside;
    /// How often the surface or curve winds around the point, counter-clockwise and outward faces
    /// counting +1: 0 is outside, anything else inside. 0 on the boundary, where there is none.
    std::int32_t winding = 0;
    /// On the boundary, the lowest face or edge that holds the point; else 0.
    std::uint32_t on = 0;
    friend bool operator==(const point_location&, const point_location&) = default;
};

/// An edge, from its lower to its higher point, that faces do not run along as often one way as
/// the other; the lowest such, or none: then the mesh is closed as far as winding numbers go. It
/// may consist of parts, be non-manifold, fold, and pass through itself. Faces that repeat a
/// corner have no say. Corners count by number: join equal ones first (`join_equal_points`).
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(V + F log d) time for at most d faces at a point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<std::array<std::uint32_t, 2>> find_open_edge(
    mesh_view mesh);

/// Where a point is with respect to a closed mesh.
///
/// Exact on the coordinates as given, for every point: a ray along x is counted through, with each
/// edge that it grazes taken as lying to one side of it by a rule that all faces share. No other
/// ray is ever tried. Points with equal coordinates are one.
///
/// \throws std::invalid_argument when the mesh is open, naming an edge that is (`find_open_edge`),
///         naming a face with a corner out of range or not finite, or the point that is not finite
/// \cost   O(F log F) for the indexes, which a prepared mesh keeps; O(log F + B) a point, for the B
///         faces whose boxes meet the ray from the point along +x
/// \same   on any number of threads
/// \source the half-open rule is the simulation of a ray moved by (0, eps, eps^2): Edelsbrunner and
///         Muecke, Simulation of Simplicity, ACM TOG 9 (1990)
[[nodiscard]] TREEFORM_API point_location locate(const prepared_mesh& mesh, const point3& point);
[[nodiscard]] TREEFORM_API point_location locate(mesh_view mesh, const point3& point);

/// [P] The same for many points, in their order, in parallel.
[[nodiscard]] TREEFORM_API std::vector<point_location> locate(const prepared_mesh& mesh,
                                                              std::span<const point3> points);
[[nodiscard]] TREEFORM_API std::vector<point_location> locate(mesh_view mesh,
                                                              std::span<const point3> points);

/// Whether the solid that the mesh bounds contains the point, its surface included: where the
/// winding number is not 0 (`fill_rule::nonzero`), or on a face. As `locate` for the rest.
[[nodiscard]] TREEFORM_API bool contains(const prepared_mesh& mesh, const point3& point);
[[nodiscard]] TREEFORM_API bool contains(mesh_view mesh, const point3& point);

/// How often the surface winds around the point; 0 on the surface. As `locate` for the rest.
[[nodiscard]] TREEFORM_API int winding_number(const prepared_mesh& mesh, const point3& point);
[[nodiscard]] TREEFORM_API int winding_number(mesh_view mesh, const point3& point);

/// An edge of a curve, from one point to another; the inside of a simple curve is on its left.
using curve_edge = std::array<std::uint32_t, 2>;

/// What algorithms take: somebody else's arrays.
struct curve_view {
    std::span<const point2> points;     ///< [V]
    std::span<const curve_edge> edges;  ///< [E]
};

/// The edges of the closed polygon through points 0, 1, ... count - 1.
[[nodiscard]] TREEFORM_API std::vector<curve_edge> polygon_edges(std::uint32_t count);

/// The tree over the boxes of the edges.
///
/// \throws std::invalid_argument as `build_face_tree`
[[nodiscard]] TREEFORM_API tree<2> edge_tree(curve_view curves);

/// Points of the plane against closed curves: any number of them, also crossing or repeated. Exact
/// in the same sense as `locate`.
class TREEFORM_API curve_locator {
  public:
    /// `tree` is `edge_tree(curves)`; it and the arrays of `curves` outlive the locator.
    ///
    /// \throws std::invalid_argument naming the lowest point that not as many edges lead to as
    ///         from, an edge with an end out of range, or a tree of another number of edges
    curve_locator(curve_view curves, const tree<2>& tree);

    /// \throws std::invalid_argument when a coordinate is not finite; likewise below
    /// \cost   O(log E + B) for the B edges whose boxes meet the ray from the point along +x
    [[nodiscard]] point_location locate(const point2& point) const;

    /// [P] the same for many points, in their order.
    /// \same on any number of threads
    [[nodiscard]] std::vector<point_location> locate(std::span<const point2> points) const;

  private:
    curve_view curves_;
    const tree<2>* tree_;
};

}  // namespace treeform
