#pragma once
/// \file
/// Whether two bodies are apart, touch or penetrate each other; how far apart they are, and where;
/// how deep they penetrate, and how many points of a cloud are inside; how thick walls are.

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

/// How two meshes lie to each other; see `relation`. The last two occur only with a clearance.
enum class mesh_relation : std::uint8_t {
    separate,
    touching,
    penetrating,
    closer_than_clearance,
    clear  ///< separate, by the clearance or more
};

/// How to look.
struct measure_options {
    double radius = std::numeric_limits<double>::infinity();  ///< of `measure`; inclusive
    /// Only closed meshes have an inside; this decides whether a mesh is closed.
    vertex_identity vertices = vertex_identity::by_coordinates;
    progress_callback progress{};
};

struct mesh_relation_result {
    mesh_relation relation = mesh_relation::separate;
    /// Faces that show why: two that pass through each other, overlap on the same side of both, or
    /// touch. For a mesh inside the other, or reaching into it, the lowest face there. Both are 0
    /// when the meshes are separate.
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    bool a_inside_b = false;  ///< a part of `a` lies inside the solid `b` and does not touch `b`
    bool b_inside_a = false;  ///< the same with `a` and `b` exchanged
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// How `a` and `b` lie to each other, exactly on the coordinates as given.
///
/// They penetrate each other in any of these cases:
/// - two faces pass through each other;
/// - both meshes are closed (`find_open_edge`), and coplanar faces overlap with what is inside on
///   the same side of them;
/// - one mesh is closed, and a corner of the other lies strictly inside it, as when one mesh is
///   entirely inside the other.
///
/// What is inside is where the winding number is not 0, as in `boolean`: so a mesh that is inside
/// out (`count_inside_out`) is the same solid.
///
/// Otherwise they touch when they have a common point, and are separate when they have none.
///
/// Corners with equal coordinates are one vertex unless the options say otherwise. So a file that
/// repeats its corners, as STL does, is closed when its surface is. With `by_index` such a mesh is
/// open, and what is inside it is separate.
///
/// For closed meshes, penetrating means that their interiors have a common point. One case is
/// treated as touching all the same: a body that passes through the other along nothing but edges
/// and corners of both, with all its corners outside or on the other's surface.
///
/// \throws std::invalid_argument naming the mesh and its lowest face with a corner out of range
///         or not finite
/// \cost   as `intersects` for meshes that penetrate or are far apart; else O(V) more, and a ray
///         for each component, or for each corner when the meshes touch
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_relation_result relation(const mesh_ref& a, const mesh_ref& b,
                                                         const measure_options& options = {});

/// The components of a closed mesh that are inside out, their volumes negative, and that are in no
/// other one, as cavities are. Components are what edges link, with corners of equal coordinates
/// joined. 0 for an open mesh, which has no inside, and for a cloud. `relation`, `clash` and
/// `locate` take such a component for the same solid; `repair` turns it over.
///
/// \throws std::invalid_argument naming the lowest face with a corner out of range or not finite
/// \cost   O(F log F) for the indexes, which a prepared mesh keeps, and a ray for each component
///         where there are several
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::uint64_t count_inside_out(const mesh_ref& mesh);

/// A point of a surface.
struct surface_point {
    std::uint32_t face = 0;
    point3 point{};  ///< rounded
    /// Weights of the corners of the face that give the point: each 0 or more, their sum 1,
    /// rounded. For a face without area, weights of two corners.
    std::array<double, 3> barycentric{1.0, 0.0, 0.0};
    friend bool operator==(const surface_point&, const surface_point&) = default;
};

/// How two meshes lie to each other.
struct mesh_measure {
    mesh_relation_result relation{};  ///< its status is that of the whole answer
    /// Not squared. 0 if and only if the meshes touch or penetrate each other.
    double distance = 0.0;
    /// Exactly 0 if and only if a face of one meets a face of the other. So it is positive for a
    /// mesh inside a solid whose surface it does not touch.
    double surface_distance = 0.0;
    surface_point on_a{};  ///< nearest points of the surfaces; where they meet, a common one
    surface_point on_b{};
};

/// The relation of `a` and `b`, their distance and their nearest points. None when one has no
/// faces, or when they are separate and further apart than `options.radius`.
///
/// The relation is exact (see `relation`), and so is whether a distance is 0. Other distances are
/// rounded as `distance` says. When the two faces that `relation` names meet, the points are on
/// them.
///
/// \throws std::invalid_argument as `relation`, and for a radius that is negative or NaN
/// \cost   that of `distance`, and of `relation` where the boxes of the meshes meet
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_measure> measure(const mesh_ref& a, const mesh_ref& b,
                                                               const measure_options& options = {});

/// How to search for the least move apart.
struct depth_options {
    std::size_t directions =
        256;  ///< spread over the sphere, tried beside those of faces that meet
    /// Pairs of faces that the search may look at, a pair in motion counting as two; 0: 20 million
    /// and 200 for each face.
    std::uint64_t effort = 0;
    vertex_identity vertices = vertex_identity::by_coordinates;  ///< as in `relation`
    progress_callback progress{};
};

/// The move apart that was found.
struct penetration_depth_result {
    double depth = 0.0;  ///< the length of `move`, rounded
    /// Adding this to every point of `a`, each coordinate rounded, takes `a` out of `b`: then
    /// `relation` does not find them penetrating.
    point3 move{};
    /// What the search took. Where some of its questions were cut, one more reason why a shorter
    /// way may exist.
    search_effort effort{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The length of a short translation that takes `a` out of `b`: an upper bound of the depth of
/// penetration, which is the length of the shortest. None when they do not penetrate each other,
/// or one is a cloud.
///
/// The translation is verified exactly, in the coordinates that it leads to. It starts from what
/// `separate` finds, is shortened wherever one of `directions` other directions leads out sooner,
/// and then turned little by little, by less and less, as long as that makes it shorter. Among
/// shapes that are not convex, a shorter one may exist.
///
/// The search ends by its effort: a place of which it takes more than a 32nd of that to say whether
/// it is out is passed over. So faces whose boxes overlap in great numbers, as those of long thin
/// triangles do, give a longer way, but at least the one along an axis past the box of `b`.
///
/// \throws std::invalid_argument as `relation`
/// \cost   `separate`; an `intersects` for each direction, and a `time_of_impact` for those that
///         lead out sooner; not more than `options.effort`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<penetration_depth_result> penetration_depth(
    const mesh_ref& a, const mesh_ref& b, const depth_options& options = {});

/// How the thickness of a wall is measured at a face.
enum class thickness_by : std::uint8_t {
    ray,    ///< along its normal, inward from its center, to the first face that is left there
    sphere  ///< the diameter of the largest ball within that touches its center
};

/// The thickness at each face, and the least.
struct thickness_result {
    /// [F] Infinite where nothing is behind a face, or it has no area.
    std::vector<double> of_face{};
    double least = std::numeric_limits<double>::infinity();  ///< of all faces
    std::uint32_t thinnest = 0;                              ///< the lowest face with that
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is returned
};

/// How thick the walls of a solid are, face by face. Which face a ray leaves through is exact, for
/// the center and normal as rounded; lengths are rounded. A ball is found to 2^-20 of its diameter.
/// Near a sharp edge balls are small: there, they measure the edge.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite
/// \cost   a `raycast_all` for each face, and some ten `closest_point` for a ball
/// \same   on any number of threads
/// \source Ma, Bae and Choi, 3D Medial Axis Point Approximation Using Nearest Neighbors and the
///         Normal Field, The Visual Computer 28 (2012)
[[nodiscard]] TREEFORM_API thickness_result wall_thickness(const mesh_ref& mesh,
                                                           thickness_by by = thickness_by::ray,
                                                           const progress_callback& progress = {});

/// How many points are inside a solid, on a surface, outside of all.
struct side_counts {
    std::uint64_t inside = 0;   ///< points strictly inside one of the solids
    std::uint64_t on = 0;       ///< points on the surface of one, and inside none
    std::uint64_t outside = 0;  ///< points outside all
};

/// Counts the points by where they are with respect to `solids`, exactly: strictly inside any of
/// them, else on the surface of any, else outside. Meshes that are open, and clouds, bound nothing
/// and are passed over.
///
/// \throws std::invalid_argument naming the point that is not finite, or a face as `locate` does
/// \cost   as `deviation` without distances, for points in the box of a solid
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API side_counts count_sides(points_view points, const mesh_refs& solids);

}  // namespace treeform
