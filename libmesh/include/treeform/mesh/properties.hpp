#pragma once
/// \file
/// Properties of a mesh: defects, counts of edges and components, whether it is closed, its volume;
/// its flat and cylindrical regions.

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

/// Points and faces with defects, ascending. A face is in at most one list.
struct mesh_defects {
    std::vector<std::uint32_t> nonfinite_points;    ///< with a NaN or infinite coordinate
    std::vector<std::uint32_t> nonfinite_faces;     ///< with such a corner
    std::vector<std::uint32_t> degenerate_faces;    ///< finite, with exactly collinear corners
    std::vector<std::uint32_t> out_of_range_faces;  ///< with a corner out of range
    friend bool operator==(const mesh_defects&, const mesh_defects&) = default;
};

/// Finds the points and faces that algorithms refuse or treat in a special way.
///
/// Whether corners are collinear is exact: they are when a corner is repeated or two are equal;
/// they are not in a sliver, however thin. A face is first tested for corners out of range, then
/// for corners that are not finite.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points or faces
/// \cost   O(V + F) time, memory for what is found
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_defects find_defects(const mesh_ref& mesh);

/// Counts over the faces with three different corner numbers. Faces that repeat a corner have no
/// edges here and are counted separately. Faces with collinear corners, and duplicates, are counted
/// like all others. The Euler characteristic is points_used - edges + faces.
struct topology_counts {
    std::uint64_t edges = 0;                  ///< undirected
    std::uint64_t boundary_edges = 0;         ///< used by one face
    std::uint64_t nonmanifold_edges = 0;      ///< used by three or more faces
    std::uint64_t misoriented_edges = 0;      ///< used by two faces in the same direction
    std::uint64_t nonmanifold_points = 0;     ///< whose faces fall into more than one fan
    std::uint64_t components_by_point = 0;    ///< faces linked by a shared corner
    std::uint64_t components_by_edge = 0;     ///< faces linked by a shared edge
    std::uint64_t points_used = 0;            ///< corners of at least one such face
    std::uint64_t faces = 0;                  ///< faces with three different corners
    std::uint64_t repeated_corner_faces = 0;  ///< the others
    std::uint64_t duplicate_faces = 0;        ///< beyond the first with the same three corners
    bool closed = false;  ///< at least one face, no boundary edge, no nonmanifold edge
};

/// Counts edges, components and defects of a mesh. Only corner numbers matter, so corners with
/// equal coordinates should be joined first (`join_equal_points`).
///
/// A fan of a point is a set of its faces that are linked by edges at that point, however many
/// faces an edge has. Neither fans nor components depend on the orientation of faces.
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
/// \cost   O(V + F) time except for an inverse Ackermann factor, about 8 bytes a point
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<std::uint32_t> face_components(std::size_t point_count,
                                                                      std::span<const face> faces);

/// The volume inside a closed mesh, in cubic units; negative when the mesh is inside out. A region
/// that the surface winds around several times counts that often. For an open mesh, the sum of the
/// signed volumes of the tetrahedra from the origin to its faces. 0 for an empty mesh.
///
/// Computed in twice the precision of double, and rounded at the end. The error before that is a
/// few units of 2^-100 times the sum, over the faces, of the largest product of three coordinates.
/// So the volume of a small part far from the origin is right, too. Not finite when such a product
/// is beyond the range of double.
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

/// Of a solid of density 1.
struct mass_properties {
    double volume = 0.0;  ///< what the mesh encloses; negative where it is inside out
    point3 center{};      ///< of mass
    /// About the center, by axes x, y and z: the energy of turning by w is w . (inertia w) / 2.
    std::array<std::array<double, 3>, 3> inertia{};
    friend bool operator==(const mass_properties&, const mass_properties&) = default;
};

/// Volume, center of mass and inertia of what a closed mesh encloses. Where it is inside out,
/// volume and inertia have the opposite sign. A region that the surface winds around several times
/// counts that often. None where the volume is 0, as of an empty mesh, or so small beside what
/// cancels in its sum that the center would be noise, or not finite; of an open one, they mean
/// little.
///
/// Coordinates are first taken from the middle of the box, which rounds them by at most 2^-53 of
/// its diagonal; sums are then made in twice the precision of double, of products that are off by
/// 2^-50 at most.
///
/// \pre    every coordinate is finite
/// \throws std::invalid_argument naming the lowest face with a corner out of range
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mass_properties> find_mass_properties(
    const mesh_ref& mesh);

/// Whether two meshes have the same faces, by the coordinates of their corners (-0 equals +0, NaN
/// equals nothing), turned the same way; in their order, each from its first corner on, or in any.
///
/// \pre  every corner is a point
/// \cost O(F), and O(F log F) in any order
[[nodiscard]] TREEFORM_API bool same_triangles(mesh_view a, mesh_view b, bool any_order);

/// What kind of region.
enum class feature_kind : std::uint8_t { plane, axis };

/// A plane or an axis, fitted to faces by least squares.
struct mesh_feature {
    feature_kind kind = feature_kind::plane;  ///< plane or axis
    point3 origin{};                          ///< center of the faces, on the plane or the axis
    point3 direction{};      ///< of length 1: the normal, outward; along the axis, either way
    double radius = 0.0;     ///< of the cylinder
    bool hollow = false;     ///< of a cylinder: the faces look at the axis, as those of a hole
    double area = 0.0;       ///< of the faces
    double deviation = 0.0;  ///< largest distance of a corner from the plane or cylinder
    std::vector<std::uint32_t> faces{};  ///< ascending
};

/// What counts as flat or cylindrical.
struct feature_options {
    /// Largest distance of a corner from the plane or cylinder. Default: 1e-4 of the diagonal.
    std::optional<double> tolerance{};
    double plane_angle = 1.0;   ///< in degrees: what faces of a plane may lean
    double facet_angle = 46.0;  ///< in degrees: the most between faces of a cylinder side by side
    double arc = 60.0;          ///< in degrees: the least part of a circle that makes an axis
    progress_callback progress{};  ///< of `find_features`, which finds nothing if asked to stop
};

/// The flat or cylindrical regions of `mesh`, largest area first. A region grows over edges, from
/// the largest face, or pair of faces with an angle between them, that is not yet in one. Points
/// with equal coordinates have to be one (`join_equal_points`). A cone is none.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range, and for options that are negative or NaN
/// \cost   O(F log F), times the regions that a face is tried for
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::vector<mesh_feature> find_features(
    mesh_view mesh, feature_kind kind, const feature_options& options = {});

/// The region around one face: it need not be among the largest. None where that is not flat or
/// cylindrical.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> feature_at(
    mesh_view mesh, feature_kind kind, std::uint32_t face, const feature_options& options = {});

/// The plane, or axis, of exactly these faces, whatever their deviation. None where they have no
/// area, or for an axis, where they are flat.
///
/// \throws std::invalid_argument as `find_features`, and for a face out of range
[[nodiscard]] TREEFORM_API std::optional<mesh_feature> fit_feature(
    mesh_view mesh, feature_kind kind, std::span<const std::uint32_t> faces);

}  // namespace treeform
