#pragma once
/// \file
/// An exact surface with as few corners as its planes need.

#include <libmesh/round/round_surface.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::boolean {

/// Which plane each face lies in, and which faces have to stay apart.
struct face_planes {
    mesh_view mesh;
    std::span<const std::uint32_t> plane_of;  ///< [F] face of `mesh` in whose plane each face lies
    std::span<const std::uint32_t>
        group_of{};                         ///< [faces of `mesh`] or empty: all are of one group
    std::span<const std::uint8_t> stays{};  ///< [F] 1 for faces that stay as they are; or empty
};

struct merged_faces {
    std::vector<face> faces;
    /// [F'] ascending: the face of before, or the lowest of those that were merged.
    std::vector<std::uint32_t> face_of;
    std::vector<std::uint8_t> is_new;  ///< [F'] 1 for faces that were none before
    /// [F] of each face before, the lowest of those that were merged with it: one of `face_of`.
    std::vector<std::uint32_t> merged_into;
};

/// The same set of points as `surface`, with other faces: those in one plane, of one group, that
/// share an edge with no third one are merged, points vanish inside of what is merged, and along
/// straight edges between such regions. Regions that lose no point keep their faces. Points keep
/// their numbers, also those that no face uses any more.
///
/// Exact. What is straight follows from planes and is seldom computed. A point that two sheets of
/// the surface share stays.
///
/// \pre    faces have three different corners, and meet in common corners and edges only
/// \throws std::logic_error where they do not
/// \cost   O(F log F), and O(n^1.5) for the n points that stay in a region
/// \same   on any number of threads
[[nodiscard]] merged_faces merge_coplanar(const exact_surface& surface, const face_planes& planes);

}  // namespace treeform::detail::boolean
