#pragma once
/// \file
/// Faces that meet, marked in their file by the kind of pair and by region, in colors.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/detail/export.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform {

struct face_marks {
    std::vector<std::uint8_t> kind;    ///< [F] 0: in no pair; else 1 + the gravest `pair_kind`
    std::vector<std::int32_t> region;  ///< [F] -1: in no pair

    /// Faces in at least one pair.
    [[nodiscard]] std::uint64_t marked() const {
        return kind.size() - static_cast<std::uint64_t>(std::count(kind.begin(), kind.end(), 0));
    }
};

/// The marks of `face_count` faces. Crossing is the gravest kind, then pierce, overlap, fold,
/// duplicate, touching, degenerate.
///
/// \pre `regions` are those of `pairs`, whose faces are in range
[[nodiscard]] TREEFORM_API face_marks mark_faces(std::size_t face_count,
                                                 std::span<const face_pair> pairs,
                                                 const intersection_regions& regions);

/// "#rrggbb" of each mark: gray for faces in no pair, then by `pair_kind`.
inline constexpr std::array<const char*, 1 + pair_kind_count> mark_colors{
    "#b4bac2", "#e02020", "#f08c00", "#ecd000", "#d81fbf", "#7432d6", "#00a0c0", "#6b4a2b"};

/// Gives `file` the marks of `looked_at`, its faces that were looked at: colors of faces and of
/// vertices (at a vertex, of its first face that is in a pair), and the properties tf_class and
/// tf_region of faces. Polygons become triangles; a file without numbers of vertices gets some, and
/// its other properties are left out.
///
/// \pre  `looked_at` is of this file, and `marks` of its faces
/// \cost O(V + F)
TREEFORM_API void color_marks(mesh_file& file, const usable_mesh& looked_at,
                              const face_marks& marks);

}  // namespace treeform
