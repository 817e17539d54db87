#pragma once
/// \file
/// How far a mesh can be moved among several others.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct sweep_options {
    double clearance = 0.0;  ///< the gap to leave; 0: until contact
    double latest = std::numeric_limits<double>::infinity();
    std::size_t limit = 1000;        ///< contacts listed
    base::effort* effort = nullptr;  ///< where it does not suffice, the sweep is `cancelled`
    progress_callback progress{};
};

struct sweep_meeting {
    std::size_t part = 0;
    face_contact where{};  ///< face `a` of the mesh that moves, face `b` of the part
};

struct sweep_result {
    placement_end end = placement_end::nothing_met;
    double time = 0.0;     ///< not beyond the exact one, as `time_of_impact` says
    std::size_t part = 0;  ///< the lowest one met, also at the start
    /// By ascending parts, then faces; without a clearance of all parts met at the same exact time.
    std::vector<sweep_meeting> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    predicate_counters predicates{};                 ///< without a clearance: what these took
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: nothing is known
};

/// The time at which `a`, moved by t times `motion`, first meets one of `parts`, or first comes
/// nearer than the clearance to one.
///
/// Without a clearance exact, as `time_of_impact`; with one as `time_to_distance`. A part that is
/// met, or nearer than the clearance, at the start ends it there.
///
/// \throws std::invalid_argument as these two, and for a clearance that is negative or NaN
/// \cost   that of these two for each part; parts are asked for no more than the time so far
/// \same   on every machine
[[nodiscard]] TREEFORM_API sweep_result sweep_among(const shape& a, std::span<const shape> parts,
                                                    const point3& motion,
                                                    const sweep_options& options = {});

}  // namespace treeform::detail::place
