#pragma once
/// \file
/// Distances between two meshes, and between points and a mesh; no distance is squared. Exact ray
/// casting.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/answers.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// Transforms of two meshes, and a search radius.
struct mesh_pair_options {
    transform<3>
        transform_a{};  ///< applied to the corners first; moved corners are rounded to double
    transform<3> transform_b{};
    /// For distances: ignore points further apart than this; inclusive, not squared.
    double radius = std::numeric_limits<double>::infinity();
};

/// The nearest points of two meshes.
struct closest_pair_result {
    std::uint32_t face_a = 0;  ///< the face of `a` that contains `on_a`
    std::uint32_t face_b = 0;  ///< the face of `b` that contains `on_b`
    double distance = 0.0;     ///< exactly 0 if and only if the meshes meet
    point3 on_a;               ///< the point on the surface of `a`, rounded, as is `on_b`
    point3 on_b;               ///< the point on the surface of `b`
    friend bool operator==(const closest_pair_result&, const closest_pair_result&) = default;
};

/// The nearest points of the surfaces `a` and `b`; none if one is empty, or if they are further
/// apart than the radius. Surfaces count, not solids: inside a closed mesh, the distance is that to
/// its surface.
///
/// Whether the meshes meet is decided exactly, on the coordinates as given or as moved. If they do
/// not, the error of the distance is at most 16 u L, where u = 2^-53 and L is the largest distance
/// of two corners of the returned faces. Of several pairs of faces at the same computed distance,
/// the lowest numbers are returned. If the meshes meet, any pair that meets may be returned, but
/// the same one in every run.
///
/// Prepared meshes cache tight bounds of their surfaces, which make later calls several times
/// faster for nearly flat surfaces that are not axis-aligned. Transforms other than rotations,
/// uniform scalings and reflections are slower.
///
/// \throws std::invalid_argument naming the mesh and its lowest face with a corner out of range or
///         not finite; for a transform that is not finite; for a radius that is negative or NaN
/// \cost   O(F log F) for indexes that are not built yet; then as `nearest_pair`: most pairs of
///         faces are skipped because they are too far apart along the line between the points of
///         the last pair tested
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<closest_pair_result> closest_pair(
    const mesh_ref& a, const mesh_ref& b, const mesh_pair_options& positions = {});

/// The distance between the surfaces `a` and `b`; infinite if `closest_pair` returns none.
[[nodiscard]] TREEFORM_API double distance(const mesh_ref& a, const mesh_ref& b,
                                           const mesh_pair_options& positions = {});

/// The point of a mesh that is nearest to a query.
struct closest_point_result {
    std::uint32_t face = 0;
    double distance = 0.0;
    point3 point;  ///< on the face, rounded
    friend bool operator==(const closest_point_result&, const closest_point_result&) = default;
};

/// The point of the surface of `mesh` nearest to `query`; none if the mesh is empty, or if all
/// faces are further away than `radius` (inclusive).
///
/// The error of the distance is at most 16 u L + u C, where u = 2^-53, L is the larger of the
/// distance and the diagonal of the face's box, and C is the largest coordinate. A degenerate face
/// is treated as the segment or point that it is. Of several faces at the same computed distance,
/// the lowest is returned.
///
/// \throws std::invalid_argument naming a face with a corner out of range or not finite, or a query
///         that is not finite; for a radius that is negative or NaN
/// \cost   O(F log F) and 128 bytes a face for the index, which a prepared mesh keeps. A query
///         opens O(log F) nodes in most cases; more if much of the mesh is about equally far, or if
///         the query is further away than 1e5 times the extent of the mesh
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<closest_point_result> closest_point(
    const mesh_ref& mesh, const point3& query,
    double radius = std::numeric_limits<double>::infinity());

/// [Q] The same for many queries in parallel; answers in the order of the queries.
[[nodiscard]] TREEFORM_API std::vector<std::optional<closest_point_result>> closest_point(
    const mesh_ref& mesh, std::span<const point3> queries,
    double radius = std::numeric_limits<double>::infinity());

/// A face that a ray hits. The point hit is origin + t direction.
struct mesh_hit {
    std::uint32_t face = 0;
    /// corner, edge or interior that contains the first common point
    triangle_feature at = triangle_feature::interior;
    bool coplanar = false;  ///< the ray runs in the face's plane, or the face has no area
    double t = 0.0;         ///< of the first common point; relative error below 2^-40
    double t_end = 0.0;     ///< of the last common point; equal to t unless coplanar
    friend bool operator==(const mesh_hit&, const mesh_hit&) = default;
};

/// The first face that a ray hits; none if it hits no face. Of several faces at the same point, the
/// lowest number.
///
/// The faces that a ray hits, their order, and the corner, edge or interior hit are exact. Only the
/// parameters t are rounded. A ray that hits an edge or a corner hits every face there: through a
/// vertex of six faces it has six hits at equal t, each with the vertex as a corner of its face.
/// Faces include their edges and are hit from both sides.
///
/// \throws std::invalid_argument for a ray with a zero direction or a number that is not finite
///         (t_min and t_max may be infinite); naming a face with a corner out of range or not
///         finite
/// \cost   O(F log F) for the index, which a prepared mesh keeps; for most rays O(log F) plus the
///         faces at the hit
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_hit> raycast(const mesh_ref& mesh, const ray3& ray);

/// [R] The same for many rays in parallel; answers in the order of the rays. Errors name the ray.
[[nodiscard]] TREEFORM_API std::vector<std::optional<mesh_hit>> raycast(const mesh_ref& mesh,
                                                                        std::span<const ray3> rays);

/// All faces that each ray hits, in the exact order along the ray, then by number.
[[nodiscard]] TREEFORM_API answer_lists<mesh_hit> raycast_all(const mesh_ref& mesh,
                                                              std::span<const ray3> rays);

/// The same for a single ray.
[[nodiscard]] TREEFORM_API std::vector<mesh_hit> raycast_all(const mesh_ref& mesh, const ray3& ray);

/// [R] 1 if a ray hits any face, else 0.
[[nodiscard]] TREEFORM_API std::vector<std::uint8_t> raycast_any(const mesh_ref& mesh,
                                                                 std::span<const ray3> rays);
/// Whether a single ray hits any face.
[[nodiscard]] TREEFORM_API bool raycast_any(const mesh_ref& mesh, const ray3& ray);

}  // namespace treeform
