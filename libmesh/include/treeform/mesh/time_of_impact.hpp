#pragma once
/// \file
/// How far a mesh can move in a direction, or rotate about an axis, until it meets another or comes
/// within a distance.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/slide.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform {

/// Start positions of the meshes, and limits.
struct impact_options {
    /// Applied to each mesh before the motion. The result is exact for the moved corners,
    /// which are rounded to double. A prepared mesh is not changed.
    transform<3> transform_a{};
    transform<3> transform_b{};
    /// Ignore contacts after this time.
    double latest = std::numeric_limits<double>::infinity();
    /// List at most this many contacts, those with the lowest face numbers.
    std::size_t limit = 1000;
    progress_callback progress{};
};

/// A pair of faces that meet when the meshes first do.
struct face_contact {
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    feature_pair at{triangle_feature::v0,
                    triangle_feature::v0};  ///< features that meet; other features may meet, too
    point3 point{};                         ///< a common point, on `b`, rounded
    friend bool operator==(const face_contact&, const face_contact&) = default;
};

/// The first contact of two meshes.
struct impact {
    /// `contact`: the meshes meet at a time greater than 0; `starts_touching`: they have a common
    /// point at the start; `nothing_met`.
    placement_outcome outcome = placement_outcome::nothing_met;
    /// The greatest double that is not beyond the exact time t of the contact: `a` moved by
    /// `time` times the motion has not passed it. 0 if they meet at the start, infinite if never.
    double time = std::numeric_limits<double>::infinity();
    std::vector<face_contact> contacts{};  ///< pairs that meet at t, ascending; empty at the start
    std::uint64_t contact_count = 0;       ///< all pairs that meet at t, listed or not
    std::uint64_t pairs_tested = 0;        ///< pairs of faces tested; the others were skipped
    /// predicate calls for these pairs, and to compare their times
    predicate_counters predicates{};
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid
};

/// The least t >= 0 at which `a`, moved by t times `motion`, has a common point with `b`.
///
/// Exact on the coordinates as given, or as moved by the options. Times of pairs of faces are
/// compared as exact quotients of determinants, so all simultaneous contacts are found, even of
/// parallel or coplanar faces. Surfaces count, not solids: inside a closed mesh, `a` moves until it
/// meets the surface. Grazing is a contact.
///
/// \throws std::invalid_argument for a motion that is zero or not finite; a time that is negative
///         or NaN; naming the mesh and its lowest face with a corner out of range or not finite
/// \cost   `intersects`, plus a search along the motion, which excludes most boxes; serial
/// \same   on every machine
[[nodiscard]] TREEFORM_API impact time_of_impact(const mesh_ref& a, const mesh_ref& b,
                                                 const point3& motion,
                                                 const impact_options& options = {});

/// The first time t >= 0 after which `a`, moved by t times `motion`, is nearer to `b` than
/// `distance` (not squared).
///
/// Not exact: whether a pair comes nearer than the distance is decided to 2^-48 of the largest
/// coordinate, so a mesh that slides along a wall at exactly the distance is free. The time has
/// errors of that size along the motion, and larger ones if the motion nearly grazes. `slide`
/// checks its result. For the distance 0, use `time_of_impact`, which is exact.
///
/// `outcome` is `contact` if the meshes are nearer than the distance right after `time`, and
/// `starts_touching` if they are nearer at the start. `contacts` are the pairs of faces at the
/// distance, as computed; their points are on `b`, their features have no meaning.
///
/// The distance of two triangles is a convex function of t. So tangents from the left never pass
/// the time at which it falls to a value, and Newton's method finds that time from below.
///
/// \throws std::invalid_argument as `time_of_impact`; for a distance that is not finite or not
///         positive
/// \cost   as `time_of_impact`, plus a tree over `a`, and about 5 distances of triangles for each
///         pair
/// \same   on every machine
/// \source convex distance in motion: Cameron, Enhancing GJK, ICRA 1997, and Mirtich's conservative
///         advancement, here for pairs of faces
[[nodiscard]] TREEFORM_API impact time_to_distance(const mesh_ref& a, const mesh_ref& b,
                                                   const point3& motion, double distance,
                                                   const impact_options& options = {});

/// Turns `moving` until its distance from one of `fixed` is at most the clearance plus the
/// tolerance. `max_travel` has no effect. The axis is the line through `origin` along `direction`,
/// of any length but 0. Turns are right-handed: counter-clockwise seen against the direction.
///
/// Conservative advancement: bounds on the speed of corners guarantee that no faces meet within a
/// step, up to the rounding of distances. The returned coordinates are checked exactly: they
/// penetrate nothing, and keep the clearance as computed by `distance`. If rounding violates that,
/// the rotation is reduced by units in the last place. A mesh that touches at the start stays; one
/// that penetrates has no place. With `nothing_met`, all of `max_angle` is free. `too_many_steps`
/// means undecided: the mesh passes another at a distance that is very small compared with its
/// size, over a long way.
///
/// `travel` is 0, and `points` differ from `matrix` by a few units in the last place of the largest
/// coordinate. `contacts` are the pairs of faces within the tolerance, beyond the clearance.
/// `placement::relation` is exact: in general disjoint, by at most the tolerance beyond the
/// clearance.
///
/// Points that no face uses turn along and are otherwise ignored; points without any face are a
/// cloud.
///
/// \throws std::invalid_argument as `slide`; for an axis that is zero or not finite, an angle out
///         of range, or a tolerance that is not positive
/// \cost   for each step the pairs of faces near each other. About 10 to 100 steps to a head-on
///         contact; O(sqrt(length / gap)) steps for each radian along which it passes a mesh at a
///         gap
/// \same   on any number of threads
/// \source the idea of steps by a bound of the motion: Mirtich, Impulse-based Dynamic Simulation of
///         Rigid Body Systems (1996), conservative advancement
[[nodiscard]] TREEFORM_API placement turn(const mesh_ref& moving, const mesh_refs& fixed,
                                          const point3& origin, const point3& direction,
                                          const placement_options& options = {});

}  // namespace treeform
