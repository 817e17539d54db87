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

struct impact_options {
    /// How each mesh is moved before the motion; what is kept of it stays. A moved
    /// corner is what `transform::operator()` gives, rounded; the answer is exact about these.
    transform<3> move_a{};
    transform<3> move_b{};
    /// Contacts beyond this time count as none.
    double latest = std::numeric_limits<double>::infinity();
    /// At most this many contacts are listed, those of the lowest face numbers.
    std::size_t limit = 1000;
    progress_callback progress{};
};

enum class motion_end : std::uint8_t {
    free,      ///< the meshes do not meet
    contact,   ///< they meet at a time greater than 0
    at_start,  ///< they have a common point where they are
};

/// A pair of faces that meet when the meshes first do.
struct face_contact {
    std::uint32_t face_a = 0;
    std::uint32_t face_b = 0;
    contact at{feature::v0, feature::v0};  ///< features of the faces that meet, among others
    point3 point{};                        ///< of `b`, rounded
    friend bool operator==(const face_contact&, const face_contact&) = default;
};

struct impact {
    motion_end end = motion_end::free;
    /// The greatest double that is not beyond the exact time t of the contact: `a` moved by
    /// `time` times the motion has not passed it. 0 at the start.
    double time = 0.0;
    sweep_contact exact{};  ///< the exact time; of the first of `contacts`
    std::vector<face_contact>
        contacts{};                   ///< all pairs that meet at t, ascending; not at the start
    std::uint64_t contact_count = 0;  ///< of all of them
    std::uint64_t pairs_tested = 0;   ///< pairs of faces looked at; the rest was skipped
    predicate_counters predicates{};  ///< what these and the order of their times took
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The least t >= 0 at which `a`, moved by t times `motion`, has a point in common with `b`.
///
/// Exact on the coordinates as given, or as moved by the options: times of pairs of faces are
/// compared as the quotients of determinants that they are, so contacts at equal times are all
/// found, whatever is parallel or coplanar. It is about surfaces: inside a closed mesh, `a` runs
/// until it meets the wall. Meshes that only graze each other have a contact.
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
/// \pre it is what `time_of_impact` gave for the motion
[[nodiscard]] TREEFORM_API double time_not_beyond(const sweep_contact& contact,
                                                  const point3& motion);

struct approach_options {
    double latest = std::numeric_limits<double>::infinity();  ///< as for `time_of_impact`
    std::size_t limit = 1000;
    progress_callback progress{};
};

struct approach {
    /// contact: the meshes come to be nearer than the distance after `time`. at_start: they are
    /// nearer than it where they are.
    motion_end end = motion_end::free;
    double time = 0.0;
    /// The pairs of faces that have the distance at `time`, as computed; ascending. Their points
    /// are of `b`, their features mean nothing.
    std::vector<face_contact> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The time t >= 0 from which on `a`, moved by t times `motion`, is nearer than `distance` (not
/// squared) to `b` for the first time.
///
/// The distance of two triangles is a convex function of t, so tangents from its left never pass
/// the time at which it falls to a value: Newton's method finds it from below. Whether a pair comes
/// nearer than the distance at all is decided to 2^-48 of the largest coordinate: a mesh that
/// slides along a wall at just the distance goes on. For the distance 0 there is `time_of_impact`,
/// which is exact; here the time has rounding errors of that size along the motion, more where the
/// motion nearly grazes. `slide` looks at the place itself.
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
