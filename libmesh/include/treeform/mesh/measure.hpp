#pragma once
/// \file
/// The relation of two bodies (disjoint, touching or penetrating), their distance and nearest
/// points, penetration depth, points of a cloud inside, and wall thickness.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// The relation of two meshes; see `relation`. The last two occur only with a clearance.
enum class mesh_relation : std::uint8_t {
    disjoint,
    touching,
    penetrating,
    closer_than_clearance,
    clear  ///< disjoint, by at least the clearance
};
template <>
inline constexpr auto detail::names_of<mesh_relation> =
    std::array{"disjoint", "touching", "penetrating", "closer-than-clearance", "clear"};

/// Options of `relation`, `measure` and `penetration_depth`. Each ignores those that do not concern
/// it.
struct measure_options {
    /// For `measure`: ignore meshes farther apart than this; inclusive, not squared.
    double radius = std::numeric_limits<double>::infinity();
    /// Only closed meshes have an inside; this decides whether a mesh is closed.
    vertex_identity vertices = vertex_identity::by_coordinates;
    /// For `penetration_depth`: number of directions, spread over the sphere, to try besides the
    /// normals of faces that meet.
    std::size_t directions = 256;
    /// For `penetration_depth`: largest number of pairs of faces to test; a pair in motion counts
    /// as two. 0: 20 million plus 200 for each face.
    std::uint64_t effort = 0;
    progress_callback progress{};
};

/// A point of a surface.
struct surface_point {
    std::uint32_t face = 0;
    point3 point{};  ///< rounded
    /// Barycentric coordinates of the point in the face: each 0 or more, their sum 1, rounded. For
    /// a face without area, weights of two corners.
    std::array<double, 3> barycentric{1.0, 0.0, 0.0};
    friend bool operator==(const surface_point&, const surface_point&) = default;
};

/// The relation and distance of two meshes.
struct relation_result {
    mesh_relation relation = mesh_relation::disjoint;
    /// Faces that prove the relation: two that cross, overlap with the inside on the same side, or
    /// touch. For a mesh that is entirely or partly inside the other, its lowest face there. Both
    /// are 0 if the meshes are disjoint.
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    bool a_inside_b = false;  ///< a component of `a` is inside the solid `b` without touching it
    bool b_inside_a = false;  ///< the same with `a` and `b` exchanged
    /// Not squared. 0 if and only if the meshes touch or penetrate each other.
    double distance = 0.0;
    /// Exactly 0 if and only if a face of one meets a face of the other. So it is positive for a
    /// mesh inside a solid whose surface it does not touch.
    double surface_distance = 0.0;
    surface_point on_a{};  ///< nearest points of the surfaces; a common point if they meet
    surface_point on_b{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// The relation of `a` and `b`, exact on the coordinates as given. Distances of the result are NaN,
/// and its points are not set: `measure` finds them.
///
/// They penetrate each other in any of these cases:
/// - two faces pass through each other;
/// - both meshes are closed (`find_open_edge`), and coplanar faces overlap with the inside of both
///   on the same side;
/// - one mesh is closed, and a corner of the other is strictly inside it; for example, one mesh is
///   entirely inside the other.
///
/// Inside is where the winding number is not 0, as in `boolean`; so a mesh that is inside out
/// (`count_inside_out`) is the same solid.
///
/// Otherwise they touch if they have a common point, and are disjoint if not.
///
/// By default corners with equal coordinates are one vertex, so a mesh that repeats its corners, as
/// from STL, is closed if its surface is. With `by_index` such a mesh is open, and a mesh inside it
/// is disjoint.
///
/// For closed meshes, penetrating means that their interiors have a common point. One exception
/// counts as touching: a body that passes through the other only along edges and corners of both,
/// with all its corners outside or on the other's surface.
///
/// \throws std::invalid_argument naming the mesh and its lowest face with a corner out of range
///         or not finite
/// \cost   as `intersects` for meshes that penetrate or are far apart; else O(V) more, plus a ray
///         for each component, or for each corner if the meshes touch
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API relation_result relation(const mesh_ref& a, const mesh_ref& b,
                                                    const measure_options& options = {});

/// The number of components of a closed mesh that are inside out (of negative volume) without being
/// cavities, that is, inside no other component. Components are faces linked by edges, with corners
/// of equal coordinates joined. 0 for an open mesh and for a cloud. `relation`, `clash` and
/// `locate` treat such a component as the solid that it bounds; `repair` flips it.
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range or not finite
/// \cost   O(F log F) for the indexes, which a prepared mesh keeps; a ray for each component, if
///         there are several
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::uint64_t count_inside_out(const mesh_ref& mesh);

/// The relation of `a` and `b`, their distance and their nearest points. None if one is empty,
/// or if they are disjoint and further apart than `options.radius`.
///
/// The relation is exact (see `relation`), and so is whether a distance is 0. Other distances are
/// rounded as in `distance`. If the two faces named by `relation` meet, the points are on them.
///
/// \throws std::invalid_argument naming the mesh and its lowest face with a corner out of range or
///         not finite; for a radius that is negative or NaN
/// \cost   `distance`; if the boxes of the meshes meet, also `mesh_intersections` and `locate`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<relation_result> measure(
    const mesh_ref& a, const mesh_ref& b, const measure_options& options = {});

/// The separating translation found.
struct penetration_depth_result {
    double depth = 0.0;  ///< the length of `move`, rounded
    /// Translation that separates them: added to every point of `a`, with each coordinate rounded,
    /// it ends the penetration.
    point3 move{};
    /// The effort of the search. If `skipped_candidates` is not 0, a shorter translation is more
    /// likely to exist.
    search_effort effort{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// The length of a short translation that separates `a` from `b`: an upper bound of the penetration
/// depth, which is the length of the shortest one. None if they do not penetrate each other, or one
/// is a cloud.
///
/// The translation is verified exactly, in the moved coordinates. The search starts with the result
/// of `separate`, tries `directions` other directions, and then rotates the best one in ever
/// smaller steps as long as it becomes shorter. For nonconvex shapes, a shorter one may exist.
///
/// The search is limited by its effort: a candidate is skipped if testing it would take more than
/// 1/32 of the effort. So if very many boxes of faces overlap, as with long thin triangles, the
/// result may be longer, but at most the translation along an axis past the box of `b`.
///
/// \throws std::invalid_argument as `relation`
/// \cost   `separate`; an `intersects` for each direction, and a `time_of_impact` for each shorter
///         one; at most `options.effort`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<penetration_depth_result> penetration_depth(
    const mesh_ref& a, const mesh_ref& b, const measure_options& options = {});

/// How wall thickness is measured at a face.
enum class thickness_by : std::uint8_t {
    /// The length of the ray from the center of the face, against its normal, to the first face
    /// through which it leaves the solid.
    ray,
    sphere  ///< the diameter of the largest inscribed ball that touches the center of the face
};

/// The thickness at each face, and the least thickness.
struct thickness_result {
    /// [F] The thickness at each face; infinite if nothing is behind it, or if it has no area.
    std::vector<double> of_face{};
    double min = std::numeric_limits<double>::infinity();  ///< smallest thickness of all faces
    /// The lowest face with the least thickness.
    std::uint32_t thinnest = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// The wall thickness of a solid at each face. The face through which a ray leaves is exact, for
/// the rounded center and normal; lengths are rounded. Balls are accurate to 2^-20 of their
/// diameter. Near a sharp edge, balls are small: there, their diameter is not the thickness of a
/// wall.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite
/// \cost   a `raycast_all` for each face, and about ten `closest_point` for each ball
/// \same   on any number of threads
/// \source Ma, Bae and Choi, 3D Medial Axis Point Approximation Using Nearest Neighbors and the
///         Normal Field, The Visual Computer 28 (2012)
[[nodiscard]] TREEFORM_API thickness_result wall_thickness(const mesh_ref& mesh,
                                                           thickness_by by = thickness_by::ray,
                                                           const progress_callback& progress = {});

/// The numbers of points inside, on and outside of `solids`, exactly: strictly inside any solid,
/// else on the surface of any, else outside. Open meshes and clouds are ignored.
///
///     const auto [inside, on, outside] = tf::count_sides(points, {bed, box});
///
/// \throws std::invalid_argument naming a point that is not finite, or a face as in `locate`
/// \cost   as the signs of `deviation`, for points in the box of a solid
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::array<std::uint64_t, 3> count_sides(points_view points,
                                                                    const mesh_refs& solids);

}  // namespace treeform
