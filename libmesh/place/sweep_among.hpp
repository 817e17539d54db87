#pragma once
/// \file
/// How far a mesh can move among several others.

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
    double clearance = 0.0;  ///< distance to keep; 0: move until contact
    double latest = std::numeric_limits<double>::infinity();
    std::size_t limit = 1000;        ///< maximum number of contacts listed
    base::effort* effort = nullptr;  ///< when exceeded, the sweep is `cancelled`
    progress_callback progress{};
};

struct sweep_meeting {
    std::size_t part = 0;
    face_contact where{};  ///< face `a` of the moving mesh, face `b` of the part
};

struct sweep_result {
    placement_end end = placement_end::nothing_met;
    double time = 0.0;     ///< not beyond the exact time, as in `time_of_impact`
    std::size_t part = 0;  ///< lowest part met, also at the start
    /// By ascending parts, then faces. Without a clearance, includes all parts met at the same
    /// exact time.
    std::vector<sweep_meeting> contacts{};
    std::uint64_t contact_count = 0;
    std::uint64_t pairs_tested = 0;
    predicate_counters predicates{};  ///< counts without a clearance
    /// or `cancelled`: the other members are meaningless
    treeform::status status = treeform::status::ok;
};

/// The first time t at which `a`, moved by t times `motion`, meets one of `parts` or, with a
/// clearance, comes nearer than that to one.
///
/// Exact without a clearance, as in `time_of_impact`; otherwise as in `time_to_distance`. If a part
/// is met, or nearer than the clearance, at the start, the sweep ends there.
///
/// \throws std::invalid_argument as for these functions, and for a clearance that is negative or
///         NaN
/// \cost   that of these functions for each part, each limited to the earliest time so far
/// \same   on every machine
[[nodiscard]] TREEFORM_API sweep_result sweep_among(const shape& a, std::span<const shape> parts,
                                                    const point3& motion,
                                                    const sweep_options& options = {});

}  // namespace treeform::detail::place
