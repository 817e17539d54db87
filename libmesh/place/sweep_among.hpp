#pragma once
/// \file
/// When a mesh in motion meets another, or comes near it; how far it can be moved among several, or
/// to the nearest point.

#include <libmesh/base/effort.hpp>
#include <libmesh/geometry/contact_order.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// The greatest double that is not beyond the exact time of a contact.
///
/// \pre `contact` was returned by `time_of_impact` for `motion`
[[nodiscard]] double time_not_beyond(const sweep_contact& contact, const point3& motion);

/// Like `time_of_impact`; also `cancelled` when the effort is exhausted. `exact` receives the first
/// contact, which has the exact time.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact impact_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                            const tree<3>& tree_b, const point3& motion,
                                            const impact_options& options = {},
                                            base::effort* effort = nullptr,
                                            sweep_contact* exact = nullptr);

/// Like `time_to_distance`, with the same limit on effort; the check of the start position does not
/// count toward it.
///
/// \pre the trees are those of the meshes
[[nodiscard]] TREEFORM_API impact approach_of(mesh_view a, const tree<3>& tree_a, mesh_view b,
                                              const tree<3>& tree_b, const point3& motion,
                                              double distance, const impact_options& options = {},
                                              base::effort* effort = nullptr);

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
    placement_outcome outcome = placement_outcome::nothing_met;
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

struct mate_motion {
    /// From the nearest point of the mesh to the nearest point of the part; 0 when these meet, or
    /// are equal up to rounding.
    point3 motion{};
    /// The fraction of `motion` that the mesh moves: 1 except for the clearance and for rounding.
    /// Not beyond the exact time of contact, as in `sweep_among`.
    double time = 0.0;
    sweep_result met{};  ///< what stops the mesh; `at_start`: it starts nearer than the clearance
};

/// Computes the motion from `nearest`, the known relation of `a` to its nearest mesh; `parts` are
/// the meshes that may be in the way.
///
/// \throws std::overflow_error when the motion is beyond the range of doubles; also by
///         `way_between`
[[nodiscard]] TREEFORM_API mate_motion motion_to_mate(const relation_result& nearest,
                                                      const shape& a, std::span<const shape> parts,
                                                      const sweep_options& options = {});

/// The vector from the nearest point of the first mesh to the nearest point of the second.
[[nodiscard]] TREEFORM_API point3 way_between(const relation_result& nearest);

}  // namespace treeform::detail::place
