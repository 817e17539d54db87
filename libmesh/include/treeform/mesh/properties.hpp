#pragma once
/// \file
/// Properties of a mesh: defects, counts of edges and components, whether it is closed,
/// volume, mass properties; flat and cylindrical regions.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// Faces and points that are invalid, or have no area, ascending. A face is in at most one list.
struct invalid_faces {
    std::vector<std::uint32_t> nonfinite_points;    ///< with a NaN or infinite coordinate
    std::vector<std::uint32_t> nonfinite_faces;     ///< with a corner that is not finite
    std::vector<std::uint32_t> degenerate_faces;    ///< finite, with exactly collinear corners
    std::vector<std::uint32_t> out_of_range_faces;  ///< with a corner out of range
    friend bool operator==(const invalid_faces&, const invalid_faces&) = default;
};

/// Finds faces and points that most operations refuse or ignore. Other defects, such as open
/// edges: `find_solid_defects`.
///
/// Collinearity is exact: a face with a repeated corner or two equal corners is degenerate, a
/// sliver is not, however thin. A face is first tested for corners out of range, then for corners
/// that are not finite.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points or faces
/// \cost   O(V + F) time; memory for the result
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API invalid_faces find_invalid_faces(const mesh_ref& mesh);

/// Counts over the faces with three different corner numbers. Faces that repeat a corner have no
/// edges here and are counted separately. Faces with collinear corners, and duplicates, are counted
/// like all others. The Euler characteristic is points_used - edges + faces.
struct topology_counts {
    std::uint64_t edges = 0;                  ///< undirected
    std::uint64_t boundary_edges = 0;         ///< used by one face
    std::uint64_t nonmanifold_edges = 0;      ///< used by three or more faces
    std::uint64_t misoriented_edges = 0;      ///< used by two faces in the same direction
    std::uint64_t nonmanifold_points = 0;     ///< points with more than one fan of faces
    std::uint64_t components_by_point = 0;    ///< faces linked by a shared corner
    std::uint64_t components_by_edge = 0;     ///< faces linked by a shared edge
    std::uint64_t points_used = 0;            ///< points that are a corner of a counted face
    std::uint64_t faces = 0;                  ///< faces with three different corners
    std::uint64_t repeated_corner_faces = 0;  ///< faces that repeat a corner
    /// Faces with the same three corners as an earlier one.
    std::uint64_t duplicate_faces = 0;
    /// Whether there are faces, and every edge has exactly two. Orientation and fans of points do
    /// not matter.
    bool closed_manifold = false;
};

/// Counts edges, components and defects of a mesh. Only corner numbers matter, so corners with
/// equal coordinates should be joined first (`join_equal_points`).
///
/// A fan of a point is a set of its faces that are linked by edges at that point, even by edges of
/// three or more faces. Fans and components do not depend on the orientation of faces.
///
/// \throws std::invalid_argument naming the lowest face with a corner that is not less than
///         `point_count`, or for more than 2^32 - 1 faces
/// \cost   O(V + F log d) time for at most d faces at a point, about 16 bytes a face and 8 a point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API topology_counts count_topology(std::size_t point_count,
                                                          std::span<const face> faces);

/// [F] the component of each face; components are numbered in the order of their lowest face. Faces
/// that share a corner are in one component, even faces that repeat a corner.
///
/// \throws std::invalid_argument as `count_topology`
/// \cost   O(V + F) time, up to an inverse Ackermann factor; about 8 bytes a point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> face_components(std::size_t point_count,
                                                                      std::span<const face> faces);

/// The volume inside a closed mesh, in cubic units; negative if the mesh is inside out. A region
/// counts as often as the surface winds around it. For an open mesh, the sum of the signed volumes
/// of the tetrahedra from the origin to its faces. 0 for an empty mesh.
///
/// Computed in twice the precision of double, and rounded at the end. The error before that is a
/// few units of 2^-100 times the sum, over the faces, of the largest product of three coordinates.
/// So the volume of a small part far from the origin is accurate, too. Not finite if such a product
/// overflows.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(F)
/// \same   on any number of threads
/// \source Dekker, A Floating-Point Technique for Extending the Available Precision, Numer. Math.
///         18 (1971)
[[nodiscard]] TREEFORM_API double signed_volume(const mesh_ref& mesh);

/// The sum of the areas of all faces, in square units; rounded as sums of doubles are.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API double surface_area(const mesh_ref& mesh);

/// Mass properties of a solid of density 1.
struct mass_properties {
    double volume = 0.0;  ///< the enclosed volume; negative if the mesh is inside out
    point3 center{};      ///< the center of mass
    /// Inertia tensor about the center, in axes x, y and z: the kinetic energy at angular velocity
    /// w is w . (inertia w) / 2.
    std::array<std::array<double, 3>, 3> inertia{};
    friend bool operator==(const mass_properties&, const mass_properties&) = default;
};

/// Volume, center of mass and inertia of the solid that a closed mesh bounds. If the mesh is inside
/// out, volume and inertia have the opposite sign. A region counts as often as the surface winds
/// around it. None if the volume is 0 (as for an empty mesh), not finite, or so small compared with
/// the terms of its sum that the center would be noise. Meaningless for an open mesh.
///
/// Coordinates are first taken relative to the center of the box, which rounds them by at most
/// 2^-53 of its diagonal. Sums have twice the precision of double; their terms have a relative
/// error of at most 2^-50.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mass_properties> find_mass_properties(
    const mesh_ref& mesh);

/// Whether two meshes have the same faces with the same orientation. Corners are compared by
/// coordinates (-0 equals +0, NaN equals nothing). With `any_order`, faces may come in any order
/// and start at any corner; otherwise order and first corners must be equal, too.
///
/// \pre    every corner is in range
/// \cost O(F); with `any_order` O(F log F)
[[nodiscard]] TREEFORM_API bool same_triangles(mesh_view a, mesh_view b, bool any_order);

/// The kind of a feature.
enum class feature_kind : std::uint8_t { plane, axis };

/// A plane or an axis, fitted to faces by least squares.
struct mesh_feature {
    feature_kind kind = feature_kind::plane;  ///< plane or axis
    point3 origin{};                          ///< center of the faces, on the plane or the axis
    /// of length 1: the outward normal of a plane; along an axis, in either sense
    point3 direction{};
    double radius = 0.0;     ///< of the cylinder; 0 for a plane
    bool hollow = false;     ///< for a cylinder: the faces point toward the axis, as in a hole
    double area = 0.0;       ///< total area of the faces
    double deviation = 0.0;  ///< largest distance of a corner from the plane or cylinder
    std::vector<std::uint32_t> faces{};  ///< the faces that it was fitted to, ascending
};

/// What counts as flat or cylindrical.
struct feature_options {
    /// Largest distance of a corner from the plane or cylinder. Default: 1e-4 of the diagonal.
    std::optional<double> tolerance{};
    double plane_angle = 1.0;  ///< in degrees: largest angle between a face and the plane
    /// In degrees: largest angle between neighboring faces of a cylinder.
    double facet_angle = 46.0;
    double arc = 60.0;             ///< in degrees: the least arc of a cylinder
    progress_callback progress{};  ///< for `find_features`, which returns nothing if stopped
};

/// The flat or cylindrical regions of `mesh`, largest area first. Regions grow across edges, each
/// from the largest face (for an axis, the largest pair of faces with an angle between them) that
/// is not yet in a region. Join points with equal coordinates first (`join_equal_points`). Cones
/// are not found.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range; for options that are negative or NaN
/// \cost   O(F log F) if each face is tried for one region only; else more, in proportion
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_feature> find_features(
    mesh_view mesh, feature_kind kind, const feature_options& options = {});

/// The flat or cylindrical region that contains `face`. None if there is none.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> feature_at(
    mesh_view mesh, feature_kind kind, std::uint32_t face, const feature_options& options = {});

/// The plane or axis fitted to exactly these faces, however large the deviation. None if they have
/// no area, or, for an axis, if they are flat.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> fit_feature(
    mesh_view mesh, feature_kind kind, std::span<const std::uint32_t> faces);

}  // namespace treeform
