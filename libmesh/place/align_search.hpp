#pragma once
/// \file
/// The steps of an alignment from one start, and where they end.

#include <libmesh/place/align_steps.hpp>
#include <libmesh/place/align_target.hpp>
#include <treeform/tree/detail/function_ref.hpp>

#include <cstddef>
#include <span>

namespace treeform::detail::place {

/// What a search is for, in the frame of the alignment.
struct search_task {
    const align_target& fixed;
    double max_distance = endless;
    double overlap = 1.0;
    bool planes = true;
    bool welsch = false;
    bool scale = false;
    double least_scale = 0.0, most_scale = endless;  ///< of the places, also of the start
    bool accelerate = true;
    unsigned max_iterations = 100;
    double tolerance = 1e-6;
};

struct search_result {
    similarity map;
    bool converged = false;
    bool at_bound = false;  ///< the scale is as small or large as it may be
    unsigned iterations = 0;
    double width = endless;  ///< of Welsch's function at the end
    quality at{};            ///< of `map`, by that width
};

/// The place with its scale brought into the bounds; the point `center` goes where it went.
[[nodiscard]] similarity within_bounds(const search_task& task, similarity map,
                                       const Vector3d& center);

/// Steps from `start` on, and of the places on the way the best. `samples` are in an order of
/// space; `go_on` is asked before each step. `last` holds nothing, or partners of the same samples.
[[nodiscard]] search_result search(const search_task& task, const moving_points& samples,
                                   const similarity& start, matching& last,
                                   function_ref<bool(unsigned)> go_on);

/// The partners of the samples at `map`, with their weights, and how good they are.
[[nodiscard]] quality quality_at(const search_task& task, const moving_points& samples,
                                 const similarity& map, double width, matching& last);

}  // namespace treeform::detail::place
