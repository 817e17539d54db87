#pragma once
/// \file
/// Parts of a surface that all but lie in one plane get as few corners as their rims need.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::round {

struct flatten_options {
    double reach = 0.0;  ///< how far corners may be from a plane, a straight rim, and each other
    bool solid = true;   ///< the faces bound a solid: what covers each other back to back goes
    std::span<const std::uint8_t> certified{};  ///< [F] 1 for faces that no part grows into
};

struct flattened {
    std::vector<point3> points;  ///< those given, then where rims cross
    std::vector<face> faces;
    std::vector<std::uint32_t>
        face_of;                       ///< [F] face that the middle of each one lies in, or next to
    std::vector<std::uint8_t> is_new;  ///< [F] 0 for faces that are as they were
    std::uint64_t parts = 0;           ///< with other faces than before
};

/// Where faces that were meant to lie in one plane do so but for rounding, as of a CAD part that was
/// turned, cutting them along each other makes many pieces, as far apart as rounding moves them.
/// Around the faces that meet:
/// - points that are within reach of each other become one;
/// - edges get the points that are within reach of them;
/// - each flat part, grown over edges from the largest of these faces that is not in one yet,
///   becomes triangles between what its rim winds around, seen along an axis. What covers each other
///   back to back cancels. Rims between two parts become straight where all is within reach of that,
///   and where sides of a rim cross, both get a point.
/// A part that cannot be made so keeps its rim; then all begins anew with its faces, too, as those
/// that meet, at most three times; then it falls apart into its faces. Nothing, where that does not
/// end.
///
/// The sum of the boundaries stays what it was, so that a closed surface stays closed; points stay
/// where they are. Whether less meets afterwards is for the caller to see.
///
/// \param  meeting  pairs of faces that meet
/// \cost   O(F), O(n log n) for the n corners there, and O(n^1.5) for those of a rim; each at most
///         160 times
/// \same   on any number of threads
/// \source Devillers, Lazard and Lenhart, 3D Snap Rounding, SoCG 2018, for points that go into edges
///         near them
[[nodiscard]] std::optional<flattened> flatten(mesh_view surface,
                                               std::span<const face_pair> meeting,
                                               const flatten_options& options);

}  // namespace treeform::detail::round
