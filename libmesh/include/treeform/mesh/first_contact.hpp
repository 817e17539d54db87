#pragma once
/// \file
/// How far a mesh can be moved in a direction until it meets another, exactly.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/triangle_sweep.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/transform.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

struct first_contact_options {
    /// How each mesh is moved before the motion; its tree stays that of the mesh as it is. A moved
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

struct first_mesh_contact {
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
    bool cancelled = false;           ///< `progress` said stop; nothing is known
};

/// The least t >= 0 at which `a`, moved by t times `motion`, has a point in common with `b`.
///
/// Exact on the coordinates as given, or as moved by the options: times of pairs of faces are
/// compared as the quotients of determinants that they are, so contacts at equal times are all
/// found, whatever is parallel or coplanar. It is about surfaces: inside a closed mesh, `a` runs
/// until it meets the wall. Meshes that only graze each other have a contact.
///
/// \pre    `tree_a` and `tree_b` are `face_tree(a)` and `face_tree(b)`
/// \throws std::invalid_argument for a motion that is zero or not finite, a time that is negative
/// or
///         NaN, and as `mesh_intersections`
/// \cost   that of `intersects`, and of a search along the motion, which most boxes never enter;
///         serial
/// \same   on every machine
[[nodiscard]] TREEFORM_API first_mesh_contact
first_contact(mesh_view a, const tree<3>& tree_a, mesh_view b, const tree<3>& tree_b,
              const point3& motion, const first_contact_options& options = {});

/// The same with trees of its own, for a single question.
[[nodiscard]] TREEFORM_API first_mesh_contact first_contact(
    mesh_view a, mesh_view b, const point3& motion, const first_contact_options& options = {});

/// The greatest double that is not beyond the exact time of a contact. \pre it is what
/// `first_contact` gave for the motion
[[nodiscard]] TREEFORM_API double time_not_beyond(const sweep_contact& contact,
                                                  const point3& motion);

}  // namespace treeform
