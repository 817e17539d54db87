#pragma once
/// \file
/// Aligns a mesh or cloud to another one, from its present position: iterative closest point (ICP).

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
#include <string>
#include <vector>

namespace treeform {

/// What each step of ICP makes small.
enum class align_method : std::uint8_t {
    /// Distances to the planes of the nearest faces, in least squares. Where an edge or a corner is
    /// nearest, the plane through it perpendicular to the way to it. Takes few iterations on
    /// surfaces.
    point_to_plane,
    /// Distances to the nearest points, in least squares: for clouds, or where planes say little.
    point_to_point,
};

/// How to align.
struct align_options {
    /// A fixed cloud has no planes: the method is then always `point_to_point`.
    align_method method = align_method::point_to_plane;
    /// Share of the moving points that have a partner, in (0, 1]. Each step uses this share, the
    /// nearest ones, and ignores the rest.
    double overlap = 1.0;
    /// Ignore partners further apart. Not squared, not negative.
    double max_distance = std::numeric_limits<double>::infinity();
    bool scale = false;  ///< find a uniform scale, too
    unsigned max_iterations = 100;
    /// Converged when a step moves no point near the fixed mesh by more than about this share of
    /// the diagonal of that mesh's box.
    double tolerance = 1e-9;
    /// Use at most this many moving points in the steps, evenly by number; 0 is all.
    std::size_t samples = 100'000;
    /// Applied to the moving points first: any affine map.
    transform<3> start{};
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// The motion found.
struct align_result {
    std::vector<point3> points{};  ///< [V] the moving points, moved by `matrix` and rounded
    /// new = M * old, with `start` included. Far from the origin its last column is large, and so
    /// is its rounding. There, new = `pivot_moved` + (linear part of M) * (old - `pivot`) is more
    /// accurate.
    transform<3> matrix{};
    point3 pivot{};        ///< center of the box of the moving points
    point3 pivot_moved{};  ///< where it goes
    double scale = 1.0;    ///< found in addition to that of `start`
    double rms = 0.0;      ///< root mean square of the distances that count, after; 0 for none
    double rms_at_start = 0.0;
    /// Share of all moving points whose nearest fixed point is within `max_distance`, after.
    double overlap = 0.0;
    bool converged = false;
    unsigned iterations = 0;
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// For people: "after 12 steps; rms 0.01, from 0.3; overlap 1".
    [[nodiscard]] TREEFORM_API std::string message() const;
    /// The same in the terms of all placements; faces were not looked at.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// The rigid motion, with a uniform scale if asked for, that brings the moving points near the
/// fixed mesh, or near its points when it has no faces.
///
/// It is a local optimum, found from the present position. It is the right one when the motion is
/// small compared with the features of the shape. The result is never worse than the start; when
/// nothing better is found, it is `start`. To compare, the squared distances of all moving points
/// to the nearest fixed points are cut off at `max_distance` squared, and the mean is taken over
/// the `overlap` share that is nearest. Directions in which the points may slide freely (a plane on
/// a plane) are left alone. With `scale`, a bad start may shrink the moving points to nothing.
///
/// Without moving or without fixed points, the result is `start`, not converged.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range, and for an option that is out of its range
/// \throws std::overflow_error when the matrix, a point as written, or the square of a distance,
///         in about the diagonals of the fixed mesh, is beyond the range of double
/// \cost   the index of `closest_point` over the fixed mesh, a search for all moving points at the
///         start and at the end, and for the samples in each step
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
