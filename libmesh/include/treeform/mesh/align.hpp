#pragma once
/// \file
/// Aligns a mesh or cloud to another one, from its present position or from several: iterative
/// closest point (ICP).

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace treeform {

/// What each step of ICP makes small.
enum class align_method : std::uint8_t {
    /// Distances to the planes of the nearest faces, in least squares. Where an edge or a corner is
    /// nearest, the plane through it perpendicular to the way to it. Of a fixed cloud, the plane
    /// fitted to the points around the nearest one. Takes few iterations on surfaces.
    point_to_plane,
    /// Distances to the nearest points, in least squares: for clouds, or where planes say little.
    point_to_point,
    automatic,  ///< `point_to_plane` on a fixed mesh, `plane_to_plane` on a fixed cloud
    /// Of a fixed cloud, distances to the plane between the one at the moving point and the one at
    /// the fixed point, the less the more these disagree; distances across count a thousandth. No
    /// matter how differently dense the sides are, as on the rings around a scanner. On a fixed
    /// mesh the same as `point_to_plane`. Planes are fitted to the 12 nearest points, or where
    /// these are on a line to up to 192.
    plane_to_plane,
};

/// How to align.
struct align_options {
    align_method method = align_method::automatic;
    /// Share of the moving points that have a partner, in (0, 1]. Each step uses this share, the
    /// nearest ones, and ignores the rest.
    double overlap = 1.0;
    /// Partners count less the further apart they are: by exp(-d^2 / 2 v^2) (Welsch). From 3
    /// medians of the distances at the start, v is halved down to where a third of the points is
    /// within 2 v; at the end it is 4.5 medians of what is near. Up to half of the points may have
    /// no partner, and nobody needs to say how many. Otherwise all count alike.
    bool robust = true;
    /// Ignore partners further apart. Not squared, not negative.
    double max_distance = std::numeric_limits<double>::infinity();
    /// Find a uniform scale, too: from that of the start and from the one that makes both sides as
    /// large, up to twice and down to half of it each. Of these, the better one is where points of
    /// both sides, each by its own size, are nearer to the other side.
    bool scale = false;
    /// Bounds of `align_result::scale` where it is found: positive, or 0 and infinity for none. A
    /// start beyond them begins at the nearest. Equal ones are the scale, as known.
    double least_scale = 0.0;
    double most_scale = std::numeric_limits<double>::infinity();
    unsigned max_iterations = 100;  ///< from each start
    /// Converged when in 5 steps in a row the cost falls by less than this share of itself, or when
    /// a step moves no point near the fixed mesh by more than 1e-11 of the diagonal of its box.
    double tolerance = 1e-6;
    /// Places to start from, at least 1. The first is the present position; then the principal axes
    /// of both sides on each other, in their 4 ways; then turns spread evenly over all turns, small
    /// ones first, with the centers on each other. The best end wins; of equals the first.
    unsigned starts = 1;
    /// Anderson acceleration: steps learn from the 5 before them.
    bool accelerate = true;
    /// Use at most this many moving points in the steps, spread evenly over space; 0 is all.
    std::size_t samples = 100'000;
    /// Applied to the moving points first: any affine map.
    transform<3> start{};
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// How the search ended.
enum class align_end : std::uint8_t {
    converged,          ///< at a place that nothing speaks against
    out_of_iterations,  ///< `max_iterations` steps were not enough
    /// Converged, but what remains is not noise: points that are neighbors are off to the same
    /// side, by more than can be told from the right place. Often a wrong local optimum, or parts
    /// without a partner.
    ///
    /// Or the scale is at its bound, or the points of a cloud do not tell where they belong:
    /// `uncertainty` is above 0.2% of the diagonal of the fixed box, those not fitted would move
    /// all further than that, or something slides.
    doubtful,
    nothing_to_align,  ///< no points, or none has a partner
};
/// "converged", "out-of-iterations", "doubtful", "nothing-to-align"
[[nodiscard]] TREEFORM_API const char* name_of(align_end end);

/// A small motion of the moving points, and how much the distances tell of it: a turn by `turn`
/// (axis times angle) about `align_result::pivot_moved` and a shift, together by 1 in the root mean
/// square over the points.
struct align_freedom {
    point3 turn{};   ///< axis times angle, about `pivot_moved`
    point3 shift{};  ///< after the turn
    /// Share of the motion (of its squares) that is along the normals: near 0 where points slide on
    /// the surface and nothing holds them, as a plane on a plane; 1 at most.
    double stiffness = 0.0;
};

/// The motion found.
struct align_result {
    std::vector<point3> points{};  ///< [V] the moving points, moved by `matrix` and rounded
    /// new = M * old, with `start` included. Far from the origin its last column is large, and so
    /// is its rounding. There, new = `pivot_moved` + (linear part of M) * (old - `pivot`) is more
    /// accurate.
    transform<3> matrix{};
    point3 pivot{};        ///< center of the box of the moving points
    point3 pivot_moved{};  ///< where the pivot goes
    double scale = 1.0;    ///< the scale found, in addition to that of `start`
    /// Root mean square of the distances that count, after, by weights if there are; 0 for none. Of
    /// two clouds by `plane_to_plane`, the distances to the planes, as far as both sides agree.
    double rms = 0.0;
    double rms_at_start = 0.0;  ///< the same at the start, without weights
    /// Share of all moving points whose nearest fixed point is within `max_distance`, after.
    double overlap = 0.0;
    /// How many of the moving points are within 4.5 medians of the distances that count.
    std::uint64_t inliers = 0;
    /// Correlation of the signed distances of neighbors, in [-1, 1]: near 0 where they are noise,
    /// near 1 where whole regions are off to one side.
    double correlation = 0.0;
    /// How far the points may be from where they belong: the standard deviation that the distances
    /// leave, and how little they hold, as a root mean square over the points; without the motions
    /// that `undetermined` counts.
    double uncertainty = 0.0;
    /// The independent motions, least held first; none without partners.
    std::vector<align_freedom> freedoms{};
    align_end end = align_end::nothing_to_align;  ///< how the search ended
    bool converged = false;                       ///< `end` is `converged`
    unsigned iterations = 0;                      ///< steps from the best start
    unsigned start = 0;  ///< which start that was: 0 is the present position
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest means nothing

    /// How many of `freedoms`, the first ones, are so little held that their part of the motion
    /// means nothing: a stiffness below 1e-4.
    [[nodiscard]] TREEFORM_API std::size_t undetermined() const;
    /// For people: "after 12 steps; rms 0.01, from 0.3; overlap 1".
    [[nodiscard]] TREEFORM_API std::string message() const;
    /// The same in the terms of all placements; faces were not looked at.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// The rigid motion, with a uniform scale if asked for, that brings the moving points near the
/// fixed mesh, or near its points when it has no faces.
///
/// From each start it is a local optimum: the right one when the motion is small compared with the
/// features of the shape. The result is never worse than the present position; when nothing better
/// is found, it is `start`, grown or shrunk about its center to the bounds of the scale. To
/// compare, the squared distances of all moving points to the nearest fixed points are cut off at
/// `max_distance` squared, and the mean is taken over the `overlap` share that is nearest. With
/// weights, and with an overlap below 1, it is Welsch's function of the distances, by the v of the
/// end: a share that is somewhat too large does no harm. Directions in which the points may slide
/// freely (a plane on a plane) are left alone. Equal points count once on a cloud.
///
/// Along motions that are little held (a stiffness below 0.02, as of a cogwheel about its axis),
/// places up to 6% of the diagonal away are tried, too.
///
/// Whether it is the right place, distances alone do not tell. At the right place they are noise;
/// at a wrong one, regions are off to one side. From 4000 moving points on, every fourth is not
/// fitted, and is what is looked at. Where they are off, by more than noise, places around the
/// start are tried: shifts by 8% of the diagonal, turns by 14 degrees. Where they still are, a
/// cloud is in doubt when they are off by more than 0.6 times of how thick both sides are around
/// their planes. On a mesh, `converged` needs that other starts, tried with few points, do not end
/// better, and that what is off is below 0.2% of the diagonal.
///
/// Without moving or without fixed points, the result is `start`, not converged.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range, and for an option that is out of its range
/// \throws std::overflow_error when the matrix, a point as written, or the square of a distance,
///         in about the diagonals of the fixed mesh, is beyond the range of double
/// \cost   the index of `closest_point` over the fixed mesh, a search for all moving points at the
///         start and at the end, and for the samples in each step; of a fixed cloud, only for those
///         whose nearest point may have changed. Each further start: some 20 steps of 1000 points
/// \same   on any number of threads
/// \source Chen and Medioni, Object Modeling by Registration of Multiple Range Images, IVC 10
///         (1992); planes of both sides: Segal, Haehnel and Thrun, Generalized-ICP, RSS (2009);
///         Umeyama, Least-Squares Estimation of Transformation Parameters Between Two Point
///         Patterns, PAMI 13 (1991); trimming: Chetverikov, Stepanov and Krsek, IVC 23 (2005);
///         weights and acceleration: Zhang, Yao and Deng, Fast and Robust Iterative Closest Point,
///         PAMI 44 (2022); turns: Alexa, Super-Fibonacci Spirals, CVPR (2022)
[[nodiscard]] TREEFORM_API align_result align(const mesh_ref& moving, const mesh_ref& fixed,
                                              const align_options& options = {});

}  // namespace treeform
