#pragma once
/// \file
/// The distance of two meshes, and where they are nearest.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/transformed.hpp>
#include <treeform/tree/tree.hpp>

#include <cstdint>
#include <limits>
#include <optional>

namespace treeform {

/// The nearest points of two meshes.
struct mesh_pair {
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    double distance = 0.0;  ///< not squared; exactly 0 if and only if the meshes meet
    point3 on_a;            ///< rounded, as is `on_b`
    point3 on_b;
    friend bool operator==(const mesh_pair&, const mesh_pair&) = default;
};

/// The nearest points of the surfaces `a` and `b`, none when one has no faces or they are further
/// apart than `radius` (inclusive). A mesh inside a closed one is as far as from its surface.
///
/// `tree_a` and `tree_b` are trees over the faces' boxes; either may count as moved
/// (`treeform::transformed`), then so do the points, rounded to double (`treeform::transform`), and
/// the answer is about these.
///
/// That meshes meet is decided exactly. The distance otherwise is within 16 u L of the true one,
/// where u = 2^-53 and L is the largest distance of two corners of the faces named; of pairs of
/// faces that are as near, as computed, the one of the lowest numbers is named, but when meshes
/// meet it may be any pair that does, the same in every run.
///
/// \pre    coordinates of corners are finite, the trees are those of the meshes' faces
/// \throws std::invalid_argument when a tree has another size than its mesh, or the radius is
///         negative or NaN
/// \cost   see `nearest_pair`; most pairs of faces are passed over by the direction between the
///         nearest points so far, which separates them by more
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API std::optional<mesh_pair> mesh_distance(
    mesh_view a, const transformed<3>& tree_a, mesh_view b, const transformed<3>& tree_b,
    double radius = std::numeric_limits<double>::infinity());

/// The same, trees and all.
/// \throws std::invalid_argument naming a face with a corner that is no point or is not finite
[[nodiscard]] TREEFORM_API std::optional<mesh_pair> mesh_distance(
    mesh_view a, mesh_view b, double radius = std::numeric_limits<double>::infinity());

}  // namespace treeform
