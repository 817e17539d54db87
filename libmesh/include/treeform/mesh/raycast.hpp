#pragma once
/// \file
/// Where rays meet a mesh, exactly.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/triangle.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// A face that a ray meets; its parts are numbered as `feature` says.
struct mesh_hit {
    std::uint32_t face = 0;
    feature at = feature::interior;  ///< where on the face the first common point lies
    bool coplanar = false;           ///< the ray runs in the face's plane, or the face has no area
    double t = 0.0;                  ///< of the first common point, to 2^-40 of itself
    double t_end = 0.0;              ///< of the last one; equal to t unless coplanar
    friend bool operator==(const mesh_hit&, const mesh_hit&) = default;
};

/// The hits of many rays: those of ray i are hits[begin[i]] ... hits[begin[i + 1] - 1].
struct mesh_hits {
    std::vector<std::size_t> begin;  ///< [R + 1]
    std::vector<mesh_hit> hits;
};

/// The face that a ray meets first: of several at one point that of the lowest number.
///
/// Every answer is exact: which faces a ray meets, what part of each, and in which order; only the
/// numbers t are rounded. A ray that meets an edge or corner meets each face that has it, so a
/// ray through a vertex of six faces has six hits there, at equal t, each with its own name for
/// the vertex. Faces are closed, have two sides, and count in either orientation.
///
/// \throws std::invalid_argument for a ray of zero direction or with a number that is not finite,
///         except for infinite parameters; naming a face with a corner out of range or not finite
/// \cost   O(F log F) for the index, which a prepared mesh keeps; O(log F) and the faces at the
///         hit, for most rays
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_hit> raycast(const prepared_mesh& mesh,
                                                           const ray3& ray);
[[nodiscard]] TREEFORM_API std::optional<mesh_hit> raycast(mesh_view mesh, const ray3& ray);

/// [R] The same for many rays, in their order, in parallel; errors name the ray.
[[nodiscard]] TREEFORM_API std::vector<std::optional<mesh_hit>> raycast(const prepared_mesh& mesh,
                                                                        std::span<const ray3> rays);
[[nodiscard]] TREEFORM_API std::vector<std::optional<mesh_hit>> raycast(mesh_view mesh,
                                                                        std::span<const ray3> rays);

/// All faces that each ray meets, in the order of their exact parameters, then by number.
[[nodiscard]] TREEFORM_API mesh_hits raycast_all(const prepared_mesh& mesh,
                                                 std::span<const ray3> rays);
[[nodiscard]] TREEFORM_API mesh_hits raycast_all(mesh_view mesh, std::span<const ray3> rays);

/// [R] 1 where a ray meets any face, else 0.
[[nodiscard]] TREEFORM_API std::vector<std::uint8_t> raycast_any(const prepared_mesh& mesh,
                                                                 std::span<const ray3> rays);
[[nodiscard]] TREEFORM_API std::vector<std::uint8_t> raycast_any(mesh_view mesh,
                                                                 std::span<const ray3> rays);

}  // namespace treeform
