#pragma once
/// \file
/// How far a mesh can be moved among several others.

#include <treeform/mesh/counters.hpp>
#include <treeform/mesh/first_contact.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tree/export.hpp>
#include <treeform/tree/progress.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform {

struct slide_options {
    double clearance = 0.0;  ///< the gap to leave; 0: until contact
    double latest = std::numeric_limits<double>::infinity();
    std::size_t limit = 1000;  ///< contacts listed
    progress_callback progress{};
};

struct slide_contact {
    std::size_t part = 0;
    face_contact where{};  ///< face `a` of the mesh that moves, face `b` of the part
};

struct slide_result {
    motion_end end = motion_end::free;
    double time = 0.0;     ///< not beyond the exact one, as `first_contact` says
    std::size_t part = 0;  ///< the lowest one met, also at the start
    /// By ascending parts, then faces; without a clearance of all parts met at the same exact time.
    std::vector<slide_contact> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    predicate_counters predicates{};  ///< without a clearance: what these took
    bool cancelled = false;           ///< `progress` said stop; nothing is known
};

/// The time at which `a`, moved by t times `motion`, first meets one of `parts`, or first comes
/// nearer than the clearance to one.
///
/// Without a clearance exact, as `first_contact`; with one as `first_approach`. A part that is met,
/// or nearer than the clearance, at the start ends it there.
///
/// \pre    `tree_a` is `face_tree(a)`
/// \throws std::invalid_argument as these two, and for a clearance that is negative or NaN
/// \cost   that of these two for each part; parts are asked for no more than the time so far
/// \same   on every machine
[[nodiscard]] TREEFORM_API slide_result slide(mesh_view a, const tree<3>& tree_a,
                                              std::span<const still_part> parts,
                                              const point3& motion,
                                              const slide_options& options = {});

}  // namespace treeform
