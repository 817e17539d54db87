#pragma once
/// \file
/// How far a mesh can be moved in a direction until it comes within a distance of another.

#include <treeform/mesh/first_contact.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <limits>

namespace treeform {

struct first_approach_options {
    double latest = std::numeric_limits<double>::infinity();  ///< as for `first_contact`
    std::size_t limit = 1000;
    progress_callback progress{};
};

struct mesh_approach {
    /// contact: the meshes come to be nearer than the distance after `time`. at_start: they are
    /// nearer than it where they are.
    motion_end end = motion_end::free;
    double time = 0.0;
    /// The pairs of faces that have the distance at `time`, as computed; ascending. Their points
    /// are of `b`, their features mean nothing.
    std::vector<face_contact> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    bool cancelled = false;  ///< `progress` said stop; nothing is known
};

/// The time t >= 0 from which on `a`, moved by t times `motion`, is nearer than `distance` to `b`
/// for the first time.
///
/// The distance of two triangles is a convex function of t, so tangents from its left never pass
/// the time at which it falls to a value: Newton's method finds it from below. Whether a pair comes
/// nearer than the distance at all is decided to 2^-48 of the largest coordinate: a mesh that
/// slides along a wall at just the distance goes on. With `distance` 0 see `first_contact`, which
/// is exact; here the time has rounding errors of that size along the motion, more where the motion
/// nearly grazes. `settle_among` looks at the place itself.
///
/// \pre    `tree_a` and `tree_b` are `face_tree(a)` and `face_tree(b)`
/// \throws std::invalid_argument for a distance that is not finite or not positive, and as
///         `first_contact`
/// \cost   as `first_contact`, a tree over `a`, and some 5 distances of triangles a pair
/// \same   on every machine
/// \source convex distance in motion: Cameron, Enhancing GJK, ICRA 1997, and Mirtich's conservative
///         advancement, here for pairs of faces
[[nodiscard]] TREEFORM_API mesh_approach first_approach(mesh_view a, const tree<3>& tree_a,
                                                        mesh_view b, const tree<3>& tree_b,
                                                        const point3& motion, double distance,
                                                        const first_approach_options& options = {});

}  // namespace treeform
