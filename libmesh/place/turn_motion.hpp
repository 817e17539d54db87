#pragma once
/// \file
/// How far a mesh can rotate about an axis before it meets others.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/time_of_impact.hpp>
#include <treeform/tree/aabb.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// A line with a unit direction.
struct unit_axis {
    point3 origin;
    point3 direction;

    /// \pre both are finite, and `along` is not zero
    unit_axis(const point3& through, const point3& along);

    /// vector from the nearest point of the line
    [[nodiscard]] point3 across(const point3& p) const;
    [[nodiscard]] point3 velocity(const point3& p) const;  ///< at one radian per unit of time
    [[nodiscard]] transform<3> by(double radians) const;
};

/// The bounding box of `mesh` in a full turn, and its largest distance from the axis.
struct swept_ring {
    box3 box;
    double radius = 0.0;
};
/// \pre `mesh` has faces
[[nodiscard]] swept_ring ring_of(mesh_view mesh, const unit_axis& axis);

struct turn_search_options {
    double clearance = 0.0;
    double tolerance = 0.0;
    double radius = 0.0;  ///< radius by `ring_of`
    double latest = 0.0;  ///< radians
    std::size_t max_steps = 0;
    std::size_t limit = 0;
    progress_callback progress{};
};

struct turn_search {
    enum class end_of { met, free, gave_up, cancelled } outcome = end_of::free;
    double angle = 0.0;  ///< radians; nothing is met up to this angle
    std::uint64_t steps = 0;
    std::uint64_t pairs = 0;
    std::vector<placement_contact> contacts{};  ///< `fixed` is the number in `parts`
};

/// \pre nothing is nearer than the clearance at the start
[[nodiscard]] turn_search search_turn(const shape& moving, std::span<const shape> parts,
                                      const unit_axis& axis, const turn_search_options& options);

}  // namespace treeform::detail::place
