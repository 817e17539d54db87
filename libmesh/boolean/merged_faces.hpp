#pragma once
/// \file
/// Merges coplanar faces of an exact surface.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// The planes of faces, and which faces must not be merged.
struct face_planes {
    mesh_view mesh;
    /// [F] a face of `mesh` in whose plane each face lies
    std::span<const std::uint32_t> plane_of;
    std::span<const std::uint32_t>
        group_of{};                         ///< [faces of `mesh`] or empty: all are of one group
    std::span<const std::uint8_t> stays{};  ///< [F] 1 for faces that must not change; or empty
};

struct merged_faces {
    std::vector<face> faces;
    /// [F'] the former face, or the lowest of the merged ones; ascending.
    std::vector<std::uint32_t> face_of;
    std::vector<std::uint8_t> is_new;  ///< [F'] 1 for new faces
    /// [F before] the lowest face with which each was merged: one of `face_of`.
    std::vector<std::uint32_t> merged_into;
};

/// The same point set as `surface`, with fewer faces. Faces in one plane and of one group, that
/// share an edge without a third face, are merged. Points inside merged regions, and on straight
/// edges between them, are removed. Regions that lose no point keep their faces. Points keep their
/// numbers, also those that are no longer used.
///
/// Exact. Whether an edge is straight usually follows from the planes, without computation. A point
/// common to two sheets of the surface is kept.
///
/// \pre    faces have three different corners, and meet in common corners and edges only
/// \throws std::logic_error if they do not
/// \cost   O(F log F), and O(n^1.5) for the n points that stay in a region
/// \same   on any number of threads
[[nodiscard]] merged_faces merge_coplanar(const exact_surface& surface, const face_planes& planes);

}  // namespace treeform::detail::boolean
