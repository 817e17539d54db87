#pragma once
/// \file
/// The steps of an alignment from one start, and where they end; the places that it may start from,
/// and which of them are worth it.

#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/align_target.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// Target and parameters of a search, in the frame of the alignment.
struct search_task {
    const align_target& fixed;
    double max_distance = endless;
    double overlap = 1.0;
    bool planes = true;
    bool welsch = false;
    bool scale = false;
    double least_scale = 0.0, most_scale = endless;  ///< bounds of the scale, also for the start
    bool accelerate = true;
    unsigned max_iterations = 100;
    double tolerance = 1e-6;
};

struct search_result {
    similarity map;
    bool converged = false;
    bool at_bound = false;  ///< the scale is at one of its bounds
    unsigned iterations = 0;
    double width = endless;  ///< final width of Welsch's function
    quality at{};            ///< quality of `map` at that width
};

/// `map` with its scale clamped to the bounds; the image of the point `center` is kept.
[[nodiscard]] similarity within_bounds(const search_task& task, similarity map,
                                       const Vector3d& center);

/// Iterates from `start` and returns the best transform found. `samples` are in a spatial order.
/// `may_continue` is called before each step; false stops the search. `last` is empty or has the
/// partners of the same samples.
[[nodiscard]] search_result search(const search_task& task, const moving_points& samples,
                                   const similarity& start, matching& last,
                                   function_ref<bool(unsigned)> may_continue);

/// Finds the partners of the samples at `map`, sets their weights, and returns the quality.
[[nodiscard]] quality quality_at(const search_task& task, const moving_points& samples,
                                 const similarity& map, double width, matching& last);

/// The center and principal axes of a set of points.
struct inertia {
    Vector3d center = Vector3d::Zero();
    Matrix3d axes = Matrix3d::Identity();  ///< columns, right-handed, the longest axis last
    double radius = 0.0;                   ///< root mean square of the distances to the center
};
[[nodiscard]] inertia inertia_of(std::span<const Vector3d> points);
/// Weighted by area, with the area of each face at its center.
[[nodiscard]] inertia inertia_of(std::span<const Vector3d> points, std::span<const face> faces);

/// `count` starts for points with the inertia `moving`: first `present`; then the 4 rotations that
/// map its axes to those of `fixed`; then rotations from `present`, evenly distributed, by
/// ascending angle.
/// \source Alexa, Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3), CVPR (2022)
[[nodiscard]] std::vector<similarity> starts_of(const inertia& moving, const inertia& fixed,
                                                const similarity& present, std::size_t count);

/// `present` and starts near it: shifted by 8% of `diagonal` along the axes, rotated by 14 degrees
/// about lines through `center` (after `present`), and both.
[[nodiscard]] std::vector<similarity> starts_near(const Vector3d& center, const similarity& present,
                                                  double diagonal);

/// `at`, and starts displaced from it along the motions with a stiffness below `most`, in both
/// directions: by a root mean square of 0.1% to 6% of `diagonal`.
[[nodiscard]] std::vector<similarity> starts_along(std::span<const freedom> motions, double most,
                                                   const similarity& at, double diagonal);

/// A start, and the result of a search from it with few points and steps.
struct tried_start {
    std::size_t number = 0;
    search_result end{};
};

/// Tries all starts except the first with the samples `few`; returns them best first, ties by
/// number. Stops early, with the results so far, when `may_continue` returns false.
[[nodiscard]] std::vector<tried_start> try_starts(const search_task& task, const moving_points& few,
                                                  std::span<const similarity> starts,
                                                  function_ref<bool(std::size_t)> may_continue);

}  // namespace treeform::detail::place
