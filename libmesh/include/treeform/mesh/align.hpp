#pragma once
/// \file
/// A mesh or cloud aligned to another one from where it is: iterated closest points.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform {

enum class align_method : std::uint8_t {
    /// Least squares of distances to the planes of the nearest faces, or square to the way to the
    /// nearest edge or corner: few iterations on surfaces.
    point_to_plane,
    /// Least squares of distances to the nearest points: for clouds, and where planes say little.
    point_to_point,
};

struct align_options {
    /// A fixed cloud has no planes: it is always fitted to its points.
    align_method method = align_method::point_to_plane;
    /// Share of the moving points that have a partner, in (0, 1]. In each step the nearest that
    /// many count; the rest is trimmed.
    double overlap = 1.0;
    /// Partners further apart count as none. Not squared, not negative.
    double max_distance = std::numeric_limits<double>::infinity();
    bool scale = false;  ///< find a uniform scale, too
    unsigned max_iterations = 100;
    /// Converged when a step moves no point near the fixed one by more than about this share of the
    /// diagonal of its box.
    double tolerance = 1e-9;
    /// At most this many moving points are used in the steps, evenly by number; 0 is all.
    std::size_t samples = 100'000;
    /// Applied to the moving points first: an affine map of any kind.
    transform<3> start{};
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

struct align_result {
    std::vector<point3> points{};  ///< [V] the moving points, moved by `matrix` and rounded
    /// new = M * old; holds `start`. Far from the origin its last column is large, and so is its
    /// rounding: there, new = `pivot_moved` + linear part of M * (old - `pivot`) says it better.
    transform<3> matrix{};
    point3 pivot{};        ///< center of the box of the moving points
    point3 pivot_moved{};  ///< where it goes
    double scale = 1.0;    ///< found beyond what is in `start`
    double rms = 0.0;      ///< of the distances of all moving points that count, after; 0 for none
    double rms_at_start = 0.0;
    /// Share of all moving points whose nearest point is within `max_distance`, after.
    double overlap = 0.0;
    bool converged = false;
    unsigned iterations = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// The same in the terms of all placements; faces were not looked at.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// The rigid motion, with a uniform scale if asked for, that brings the moving points near to the
/// fixed mesh, or to its points when it has no faces.
///
/// Found from the present position: a local optimum, which is the right one when the motion is
/// small beside the features of the shape. The result is never worse than the start: measured
/// over all moving points, by the mean of the squared distances to the nearest fixed points, each
/// no more than `max_distance` squared, of the `overlap` share that is nearest. When nothing better
/// is found the result is `start`. Directions in which the points may slide freely (a plane on a
/// plane) are left alone. With `scale` a bad start may shrink the moving points to nothing.
///
/// Nothing moving, or nothing fixed: the start, not converged.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range, and for an option that is out of its range
/// \throws std::overflow_error where the matrix, a point as written, or some square of a distance
///         in about the diagonals of the fixed mesh, is beyond the range of doubles
/// \cost   a `closest_point_query` of the fixed mesh, a search of all moving points at the start
///         and the end, and of the samples in each step
/// \same   on any number of threads
/// \source Chen and Medioni, Object Modeling by Registration of Multiple Range Images, IVC 10
///         (1992); Umeyama, Least-Squares Estimation of Transformation Parameters Between Two Point
///         Patterns, PAMI 13 (1991); trimming: Chetverikov, Stepanov and Krsek, IVC 23 (2005)
[[nodiscard]] TREEFORM_API align_result align(points_view moving, mesh_view fixed,
                                              const align_options& options = {});

[[nodiscard]] TREEFORM_API align_result align(mesh_view moving, mesh_view fixed,
                                              const align_options& options = {});
[[nodiscard]] TREEFORM_API align_result align(const prepared_mesh& moving,
                                              const prepared_mesh& fixed,
                                              const align_options& options = {});

}  // namespace treeform
