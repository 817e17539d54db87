#pragma once
/// \file
/// Replaces nearly flat parts of a solid's surface by triangles of their rims.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct flatten_options {
    /// largest distance of corners from a plane, from a straight rim, and from each other
    double reach = 0.0;
    std::span<const std::uint8_t> certified{};  ///< [F] 1 for faces that must not belong to a part
};

struct flattened {
    std::vector<point3> points;  ///< the given points, then crossings of rims
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;  ///< [F] the former face that contains the center of each, or is next to it
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for unchanged faces
};

/// After a CAD part was rotated, its coplanar faces are no longer exactly coplanar. Cut along each
/// other, they become many pieces whose distances are below the rounding errors. Around the faces
/// that meet:
/// - points within reach of each other are joined;
/// - edges are split at points within reach of them;
/// - connected faces near one plane form a flat part, grown from the largest face that is in none;
/// - a part is replaced by triangles of the area around which its rim winds, in projection along an
///   axis; if that is empty, as for two sheets back to back, nothing is left;
/// - a rim between two parts becomes straight if all of it is within reach of the segment;
/// - where two sides of a rim cross, both are split at a new point. If a part has no such
/// triangles, its rim is not straightened. If that fails, too, the algorithm restarts with its
/// faces among those that meet, at most three times; after that, the part is replaced face by face.
/// None if that does not terminate.
///
/// Signed face counts of edges are preserved, so a closed surface stays closed. Points do not move.
/// The caller must check whether fewer faces meet afterwards.
///
/// \param  meeting  pairs of faces that meet
/// \cost   O(F), O(n log n) for the n corners of these faces, and O(n^1.5) for n corners of a rim;
///         each at most 160 times
/// \same   on any number of threads
/// \source Devillers, Lazard and Lenhart, 3D Snap Rounding, SoCG 2018, for splitting edges at near
///         points
[[nodiscard]] std::optional<flattened> flatten(mesh_view surface,
                                               std::span<const face_pair> meeting,
                                               const flatten_options& options);

}  // namespace treeform::detail::round
