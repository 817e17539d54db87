#pragma once
/// \file
/// How far a mesh can be moved in a direction until it meets another, or comes near it.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/mesh/triangle.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

/// Where the meshes start, and how far to look.
struct impact_options {
    /// Applied to each mesh before the motion. A moved corner is what `transform::operator()`
    /// gives, rounded; the answer is exact for these coordinates. A prepared mesh itself is not
    /// changed.
    transform<3> move_a{};
    transform<3> move_b{};
    /// Ignore contacts after this time.
    double latest = std::numeric_limits<double>::infinity();
    /// List at most this many contacts, those of the lowest face numbers.
    std::size_t limit = 1000;
    progress_callback progress{};
};

/// How a motion ends.
enum class motion_end : std::uint8_t {
    free,      ///< the meshes do not meet
    contact,   ///< they meet at a time greater than 0
    at_start,  ///< they have a common point where they are
};

/// A pair of faces that meet when the meshes first do.
struct face_contact {
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    contact at{feature::v0, feature::v0};  ///< features that meet; there may be others
    point3 point{};                        ///< a common point, on `b`, rounded
    friend bool operator==(const face_contact&, const face_contact&) = default;
};

/// The first contact of two meshes.
struct impact {
    motion_end end = motion_end::free;
    /// The greatest double that is not beyond the exact time t of the contact: `a` moved by
    /// `time` times the motion has not passed it. 0 when `end` is at_start.
    double time = 0.0;
    sweep_contact exact{};                 ///< the exact time; that of the first of `contacts`
    std::vector<face_contact> contacts{};  ///< pairs that meet at t, ascending; empty when at_start
    std::uint64_t contact_count = 0;       ///< all pairs that meet at t, listed or not
    std::uint64_t pairs_tested = 0;        ///< pairs of faces looked at; the rest was skipped
    predicate_counters predicates{};       ///< used for these and for the order of their times
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The least t >= 0 at which `a`, moved by t times `motion`, has a point in common with `b`.
///
/// Exact on the coordinates as given, or as moved by the options. Times of pairs of faces are
/// compared as exact quotients of determinants, so all contacts at equal times are found, even of
/// parallel or coplanar faces. Surfaces count, not solids: inside a closed mesh, `a` moves until it
/// meets the wall. Meshes that only graze each other have a contact.
///
/// \throws std::invalid_argument for a motion that is zero or not finite, a time that is negative
///         or NaN, and naming the mesh and its lowest face with a corner out of range or not
///         finite
/// \cost   that of `intersects`, and of a search along the motion, which most boxes never enter;
///         serial
/// \same   on every machine
[[nodiscard]] TREEFORM_API impact time_of_impact(const prepared_mesh& a, const prepared_mesh& b,
                                                 const point3& motion,
                                                 const impact_options& options = {});
[[nodiscard]] TREEFORM_API impact time_of_impact(mesh_view a, mesh_view b, const point3& motion,
                                                 const impact_options& options = {});

/// The greatest double that is not beyond the exact time of a contact.
///
/// \pre `contact` was returned by `time_of_impact` for `motion`
[[nodiscard]] TREEFORM_API double time_not_beyond(const sweep_contact& contact,
                                                  const point3& motion);

/// How far to look.
struct approach_options {
    double latest = std::numeric_limits<double>::infinity();  ///< as for `time_of_impact`
    std::size_t limit = 1000;
    progress_callback progress{};
};

/// When two meshes come within a distance of each other.
struct approach {
    /// contact: the meshes are nearer than the distance right after `time`. at_start: they are
    /// nearer where they are.
    motion_end end = motion_end::free;
    double time = 0.0;
    /// The pairs of faces at the distance at `time`, as computed; ascending. Their points are on
    /// `b`; their features mean nothing.
    std::vector<face_contact> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The first time t >= 0 after which `a`, moved by t times `motion`, is nearer to `b` than
/// `distance` (not squared).
///
/// Not exact: whether a pair comes nearer than the distance is decided to 2^-48 of the largest
/// coordinate, so a mesh that slides along a wall at just the distance moves on. The time has
/// rounding errors of that size along the motion, and larger ones where the motion nearly grazes.
/// `slide` checks the place itself. For the distance 0, use `time_of_impact`, which is exact.
///
/// The distance of two triangles is a convex function of t. So tangents from the left never pass
/// the time at which it falls to a value, and Newton's method finds that time from below.
///
/// \throws std::invalid_argument for a distance that is not finite or not positive, and as
///         `time_of_impact`
/// \cost   as `time_of_impact`, a tree over `a`, and some 5 distances of triangles a pair
/// \same   on every machine
/// \source convex distance in motion: Cameron, Enhancing GJK, ICRA 1997, and Mirtich's conservative
///         advancement, here for pairs of faces
[[nodiscard]] TREEFORM_API approach time_to_distance(const prepared_mesh& a, const prepared_mesh& b,
                                                     const point3& motion, double distance,
                                                     const approach_options& options = {});
[[nodiscard]] TREEFORM_API approach time_to_distance(mesh_view a, mesh_view b, const point3& motion,
                                                     double distance,
                                                     const approach_options& options = {});

}  // namespace treeform
