#pragma once
/// \file
/// Turns a mesh about an axis until it meets others.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace treeform {

/// A line to turn about, to the right (counter-clockwise, seen against `direction`).
struct turn_axis {
    point3 origin{};                  ///< any point of the line
    point3 direction{0.0, 0.0, 1.0};  ///< of any length but 0
};

/// How to turn.
struct turn_options {
    double clearance = 0.0;    ///< the gap to leave, a distance; 0: until contact
    double max_angle = 360.0;  ///< in degrees; greater than 0, up to 360
    /// The gap, beyond the clearance, that counts as contact; greater than 0. Default: 2^-32 of the
    /// largest distance of a point from the axis.
    std::optional<double> tolerance{};
    std::size_t max_steps = 20'000;
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    std::size_t limit = 1000;                                      ///< contacts listed
    vertex_identity vertices = vertex_identity::by_coordinates;    ///< as in `relation`
    progress_callback progress{};
};

/// Where a turn ended.
struct turn_result {
    /// `travel` is 0, `matrix` a turn about the axis, from which `points` differ by a few units in
    /// the last place of the largest coordinate. `contacts` are the pairs of faces within the
    /// tolerance, beyond the clearance. `standing` at the place is exact: separate, in general, by
    /// no more than the tolerance.
    placement at{};
    double angle = 0.0;      ///< of the turn, in degrees
    double tolerance = 0.0;  ///< that was used
    std::uint64_t steps = 0;

    explicit operator bool() const { return static_cast<bool>(at); }
};

/// Turns `moving` about the axis until it first comes within the tolerance of one of `fixed`, or of
/// the clearance from one.
///
/// On the way there it meets nothing, up to the rounding of distances: each step is one that no
/// pair of faces can have met in, by bounds on how fast their corners approach. At the place, the
/// coordinates returned are looked at exactly: they penetrate nothing, and keep the clearance as
/// `distance` computes it. Where rounding has it otherwise, the turn goes back by units in the last
/// place. A mesh that touches at the start stays; one that penetrates has no place. With
/// `nothing_met`, all of `max_angle` is free. With `too_many_steps` it was not found out: something
/// is passed at a distance that is very small against the size, over a long way.
///
/// Points that no face uses turn along and are otherwise ignored. Clouds are `prepared_mesh::cloud`.
///
/// \throws std::invalid_argument for an axis that is zero or not finite, an angle out of range, a
///         tolerance that is not positive, and as `slide`
/// \cost   for each step the pairs of faces near each other. Some ten to a hundred steps where it
///         comes to meet something head on; in the order of sqrt(length / gap) for each radian in
///         which it passes something at a gap
/// \same   on any number of threads
/// \source the idea of steps by a bound of the motion: Mirtich, Impulse-based Dynamic Simulation of
///         Rigid Body Systems (1996), conservative advancement
[[nodiscard]] TREEFORM_API turn_result turn(const prepared_mesh& moving,
                                            std::span<const prepared_mesh> fixed,
                                            const turn_axis& axis,
                                            const turn_options& options = {});
[[nodiscard]] TREEFORM_API turn_result turn(const prepared_mesh& moving, const prepared_mesh& fixed,
                                            const turn_axis& axis,
                                            const turn_options& options = {});
[[nodiscard]] TREEFORM_API turn_result turn(mesh_view moving, mesh_view fixed,
                                            const turn_axis& axis,
                                            const turn_options& options = {});

}  // namespace treeform
