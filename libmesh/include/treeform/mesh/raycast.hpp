#pragma once
/// \file
/// Which faces rays hit, exactly.

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

/// A face that a ray hits. The point hit is origin + t direction.
struct mesh_hit {
    std::uint32_t face = 0;
    feature at = feature::interior;  ///< corner, edge or interior that holds the first common point
    bool coplanar = false;           ///< the ray runs in the face's plane, or the face has no area
    double t = 0.0;                  ///< of the first common point; relative error below 2^-40
    double t_end = 0.0;              ///< of the last common point; equal to t unless coplanar
    friend bool operator==(const mesh_hit&, const mesh_hit&) = default;
};

/// The hits of many rays: those of ray i are hits[begin[i]] ... hits[begin[i + 1] - 1].
struct mesh_hits {
    std::vector<std::size_t> begin;  ///< [R + 1]
    std::vector<mesh_hit> hits;
};

/// The face that a ray hits first; none when it hits nothing. Of several faces at one point, the
/// lowest number.
///
/// Which faces a ray hits, on which corner, edge or interior, and in which order, is exact. Only
/// the numbers t are rounded. A ray that hits an edge or a corner hits every face that has it:
/// through a vertex of six faces it has six hits at equal t, and each names the vertex as a corner
/// of its own face. Faces include their edges and are hit from both sides.
///
/// \throws std::invalid_argument for a ray with a direction of zero or a number that is not finite
///         (t_min and t_max may be infinite); naming a face with a corner out of range or not
///         finite
/// \cost   O(F log F) for the index, which a prepared mesh keeps; for most rays O(log F) and the
///         faces at the hit
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_hit> raycast(const mesh_ref& mesh, const ray3& ray);

/// [R] The same for many rays in parallel; answers in the order of the rays. Errors name the ray.
[[nodiscard]] TREEFORM_API std::vector<std::optional<mesh_hit>> raycast(const mesh_ref& mesh,
                                                                        std::span<const ray3> rays);

/// All faces that each ray hits, in the exact order along the ray, then by number.
[[nodiscard]] TREEFORM_API mesh_hits raycast_all(const mesh_ref& mesh, std::span<const ray3> rays);

/// [R] 1 when a ray hits any face, else 0.
[[nodiscard]] TREEFORM_API std::vector<std::uint8_t> raycast_any(const mesh_ref& mesh,
                                                                 std::span<const ray3> rays);

}  // namespace treeform
