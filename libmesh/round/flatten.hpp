#pragma once
/// \file
/// Parts of a solid's surface that nearly lie in one plane, with as few faces as their rims need.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct flatten_options {
    double reach = 0.0;  ///< how far corners may be from a plane, a straight rim, and each other
    std::span<const std::uint8_t> certified{};  ///< [F] 1 for faces that no part grows into
};

struct flattened {
    std::vector<point3> points;  ///< those given, then where rims cross
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;                       ///< [F] face that the middle of each one lies in, or next to
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for faces that are as they were
};

/// Faces of a CAD part that share a plane no longer do exactly once the part has been rotated. Cut
/// along each other, they become many pieces, no further apart than rounding moves them. Around
/// the faces that meet:
/// - points that are within reach of each other become one;
/// - edges get the points that are within reach of them;
/// - connected faces near one plane are a flat part, grown from the largest face that is in none;
/// - a part is replaced by triangles of what its rim winds around, seen along an axis; where it
///   winds around nothing, as around two sheets back to back, nothing is left;
/// - a rim between two parts becomes straight where all of it is within reach of the straight way;
/// - where two sides of a rim cross, both get a new point.
/// If a part has no such triangles, its rim is not straightened. If it still has none, all starts
/// over with its faces among those that meet, at most three times. After that it is replaced face
/// by face. No result, if that does not end.
///
/// The sum of the boundaries stays what it was, so that a closed surface stays closed; points stay
/// where they are. Whether less meets afterwards is for the caller to see.
///
/// \param  meeting  pairs of faces that meet
/// \cost   O(F), O(n log n) for the n corners there, and O(n^1.5) for those of a rim; each at most
///         160 times
/// \same   on any number of threads
/// \source Devillers, Lazard and Lenhart, 3D Snap Rounding, SoCG 2018, for points that go into
///         edges near them
[[nodiscard]] std::optional<flattened> flatten(mesh_view surface,
                                               std::span<const face_pair> meeting,
                                               const flatten_options& options);

}  // namespace treeform::detail::round
