#pragma once
/// \file
/// Alignment of a mesh or cloud to another by iterative closest point (ICP), from the present
/// position or from several starts.

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

/// The cost that each step of ICP minimizes.
enum class align_method : std::uint8_t {
    /// Distances to the planes of the nearest faces, in least squares. If the nearest point is on
    /// an edge or a corner, its plane is perpendicular to the connecting segment; on a fixed cloud,
    /// its plane is fitted to the points around it. Needs few iterations on surfaces.
    point_to_plane,
    /// Distances to the nearest points, in least squares: for clouds, or where planes determine
    /// little.
    point_to_point,
    automatic,  ///< `point_to_plane` on a fixed mesh, `plane_to_plane` on a fixed cloud
    /// For a fixed cloud, distances to the mean of the planes at the moving and at the fixed point,
    /// with less weight if these disagree; distances along the plane have a weight of 1/1000.
    /// Robust to different densities, as in the rings around a scanner. On a fixed mesh the same as
    /// `point_to_plane`. Planes are fitted to the 12 nearest points, or up to 192 if these are
    /// collinear.
    plane_to_plane,
};

/// How to align.
struct align_options {
    align_method method = align_method::automatic;
    /// Share of the moving points that have a partner (a corresponding fixed point), in (0, 1].
    /// Each step uses this share of the points, those with the nearest partners.
    double overlap = 1.0;
    /// Weight partners at distance d by exp(-d^2 / (2 v^2)) (Welsch), so that up to half of the
    /// points may have no partner, without a given `overlap`. v starts at 3 times the median
    /// distance, and is halved while at least a third of the points are within v; finally it is 4.5
    /// times the median of the near distances. If false, all partners have the same weight.
    bool robust = true;
    /// Ignore partners farther apart than this. Not squared, not negative.
    double max_distance = std::numeric_limits<double>::infinity();
    /// Also find a uniform scale. The search tries scales from half to twice that of `start`, and
    /// from half to twice the scale that makes `moving` and `fixed` equally large. It compares
    /// results by the distances between both, relative to their sizes.
    bool scale = false;
    /// Bounds of `align_result::scale` if `scale` is set: positive, or 0 and infinity for none. A
    /// start outside the bounds is moved to the nearest bound. Equal bounds fix the scale.
    double least_scale = 0.0;
    double most_scale = std::numeric_limits<double>::infinity();
    unsigned max_iterations = 100;  ///< largest number of steps from each start
    /// Converged if the cost falls by less than this share in each of 5 consecutive steps, or if a
    /// step moves no point near the fixed mesh by more than 1e-11 of the diagonal of the fixed
    /// mesh's box.
    double tolerance = 1e-6;
    /// Number of starts, at least 1. The first is the present position; then the principal axes of
    /// `moving` and `fixed` aligned, in the 4 possible ways; then rotations spread evenly over all
    /// rotations, small ones first, with aligned centers. The best result is returned; of equal
    /// results the first.
    unsigned starts = 1;
    /// Anderson acceleration with the 5 previous steps.
    bool accelerate = true;
    /// Use at most this many moving points in the steps, spread evenly over space; 0 is all.
    std::size_t max_samples = 100'000;
    /// Applied to the moving points first, which gives the "present position"; any affine map.
    transform<3> start{};
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// How the search ended.
enum class align_outcome : std::uint8_t {
    converged,          ///< converged, and no test of the result failed
    out_of_iterations,  ///< `max_iterations` steps were not enough
    /// Converged, but residuals are more than noise: neighboring points deviate to the same side by
    /// more than in a correct alignment. Often a wrong local optimum, or parts without a partner.
    ///
    /// Also if the scale is at its bound, or the points of a fixed cloud do not determine the
    /// position: `uncertainty` exceeds 0.2% of the diagonal of the fixed box, a fit to the held-out
    /// points would move all points by more than that, or a motion is undetermined.
    doubtful,
    nothing_to_align,  ///< there are no points, or no point has a partner
};
template <>
inline constexpr auto detail::names_of<align_outcome> =
    std::array{"converged", "out-of-iterations", "doubtful", "nothing-to-align"};

/// A small motion of the moving points, and how well the distances determine it. It is a rotation
/// about `align_result::pivot_moved` and a shift, scaled so that the root mean square of the motion
/// over the points is 1.
struct align_freedom {
    point3 turn{};   ///< axis times angle, about `pivot_moved`
    point3 shift{};  ///< after the turn
    /// Share of the squared motion along the normals, 0 to 1: near 0 if points slide on the
    /// surface, like a plane on a plane.
    double stiffness = 0.0;
};

/// The motion found.
struct align_result {
    std::vector<point3> points{};  ///< [V] the moving points, moved by `matrix` and rounded
    /// new = M * old, with `start` included. Far from the origin its last column is large and has a
    /// large rounding error; then new = `pivot_moved` + (linear part of M) * (old - `pivot`) is
    /// more accurate.
    transform<3> matrix{};
    point3 pivot{};        ///< center of the box of the moving points
    point3 pivot_moved{};  ///< the pivot, moved by `matrix`
    double scale = 1.0;    ///< the scale found, in addition to that of `start`
    /// Root mean square of the distances at the end, weighted if weights are used; 0 without
    /// partners. For two clouds with `plane_to_plane`: of the distances to the planes, weighted by
    /// the agreement of both planes.
    double rms = 0.0;
    double rms_at_start = 0.0;  ///< the same at the start, unweighted
    /// Share of all moving points whose nearest fixed point is within `max_distance`, at the end.
    double overlap = 0.0;
    /// Number of moving points within 4.5 times the median of the distances used.
    std::uint64_t inliers = 0;
    /// Correlation of the signed distances of neighbors, in [-1, 1]: near 0 for noise, near 1 if
    /// whole regions deviate to one side.
    double correlation = 0.0;
    /// Estimated standard deviation of the position, as a root mean square over the points, from
    /// the residuals and the stiffness of the motions. Motions that `undetermined` counts are left
    /// out.
    double uncertainty = 0.0;
    /// The independent motions, ascending by stiffness; none without partners.
    std::vector<align_freedom> freedoms{};
    align_outcome outcome = align_outcome::nothing_to_align;  ///< how the search ended
    bool converged = false;                                   ///< `outcome` is `converged`
    unsigned iterations = 0;                                  ///< steps from the best start
    unsigned best_start = 0;  ///< number of the best start; 0 is the present position
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is invalid

    /// Number of `freedoms` with a stiffness below 1e-4; these come first. The data do not
    /// determine these motions.
    [[nodiscard]] TREEFORM_API std::size_t undetermined() const;
    /// For people: "aligned after 12 steps; rms 0.01, from 0.3; overlap 1"; if not converged, why.
    [[nodiscard]] TREEFORM_API std::string message() const;
    /// The result as a `placement`; contacts are not tested.
    [[nodiscard]] TREEFORM_API placement as_placement() const;
};

/// The rigid motion, with a uniform scale if requested, that brings the moving points near the
/// fixed mesh, or near its points if it has no faces.
///
/// From each start this is a local optimum: the right one if the motion is small compared with the
/// features of the shape. The result is never worse than the present position; if nothing better is
/// found, it is `start`, scaled about its center to the bounds of the scale. Results are compared
/// by a mean of squared distances to the nearest fixed points, each at most `max_distance` squared,
/// over the nearest `overlap` share of the points. If `robust`, or with an overlap below 1, they
/// are compared by the mean of Welsch's function with the final v instead, so that an overlap
/// somewhat too large does no harm. Motions in which points slide freely (a plane on a plane) are
/// not made. Equal points of a cloud count once.
///
/// Along motions with a stiffness below 0.02, such as the rotation of a gear about its axis,
/// positions up to 6% of the diagonal away are also tried.
///
/// Small distances alone do not prove that a result is correct. In a correct alignment residuals
/// are noise; in a wrong one, whole regions deviate to one side. With 4000 moving points or more,
/// every fourth is held out of the fit and used for this test. If its residuals are more than
/// noise, other starts around `start` are tried: shifts by 8% of the diagonal, rotations by 14
/// degrees. If residuals are still more than noise: on a fixed cloud, the result is `doubtful` if
/// they exceed 0.6 times the thickness of both point sets around their fitted planes. On a fixed
/// mesh, it is `doubtful` if another start, tried with few points, ends better, or if the deviation
/// exceeds 0.2% of the diagonal.
///
/// If `moving` or `fixed` has no points, the result is `start`, not converged.
///
/// \throws std::invalid_argument naming a point that is not finite or a face with a corner out of
///         range; for an option out of its range
/// \throws std::overflow_error if the matrix, a rounded point, or a squared distance relative to
///         the fixed mesh's diagonal overflows double
/// \cost   the index of `closest_point` over the fixed mesh; nearest points of all moving points at
///         the start and at the end, and of the samples in each step (for a fixed cloud, only of
///         those whose nearest point may have changed). Each further start: about 20 steps with
///         1000 points
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
