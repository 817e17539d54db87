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
/// `go_on` is called before each step; false stops the search. `last` is empty or has the partners
/// of the same samples.
[[nodiscard]] search_result search(const search_task& task, const moving_points& samples,
                                   const similarity& start, matching& last,
                                   function_ref<bool(unsigned)> go_on);

/// Finds the partners of the samples at `map`, sets their weights, and returns the quality.
[[nodiscard]] quality quality_at(const search_task& task, const moving_points& samples,
                                 const similarity& map, double width, matching& last);

/// Where a set of points is, and how it lies.
struct inertia {
    Vector3d center = Vector3d::Zero();
    Matrix3d axes = Matrix3d::Identity();  ///< columns, right-handed, along the longest last
    double radius = 0.0;                   ///< root mean square of the distances to the center
};
[[nodiscard]] inertia inertia_of(std::span<const Vector3d> points);
/// By area: each face as if in its center.
[[nodiscard]] inertia inertia_of(std::span<const Vector3d> points, std::span<const face> faces);

/// `count` places for points that lie as `moving` does: the present one, the axes on those of
/// `fixed` in 4 ways, then turns from where they are at `present`, spread evenly, small ones first.
/// \source Alexa, Super-Fibonacci Spirals: Fast, Low-Discrepancy Sampling of SO(3), CVPR (2022)
[[nodiscard]] std::vector<similarity> starts_of(const inertia& moving, const inertia& fixed,
                                                const similarity& present, std::size_t count);

/// `present`, and places around it: shifted by 8% of `diagonal` along the axes, turned by 14
/// degrees about lines through `center`, moved already, and both.
[[nodiscard]] std::vector<similarity> starts_near(const Vector3d& center, const similarity& present,
                                                  double diagonal);

/// `at`, and places from there along the motions with a stiffness below `most`: 0.1% to 6% of
/// `diagonal` away in the root mean square, both ways.
[[nodiscard]] std::vector<similarity> starts_along(std::span<const freedom> motions, double most,
                                                   const similarity& at, double diagonal);

/// A start, and what a search with few points and steps makes of it.
struct tried_start {
    std::size_t number = 0;
    search_result end{};
};

/// All starts but the first tried with `few` samples, the best end first, of equals the first.
/// Stops early, with what there is, when `go_on` says so.
[[nodiscard]] std::vector<tried_start> try_starts(const search_task& task, const moving_points& few,
                                                  std::span<const similarity> starts,
                                                  function_ref<bool(std::size_t)> go_on);

}  // namespace treeform::detail::place
