#pragma once
/// \file
/// The iterations of an alignment from one start.

#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/align_target.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <span>

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

}  // namespace treeform::detail::place
