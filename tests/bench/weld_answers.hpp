#pragma once
/// \file
/// What a way of welding makes of a cloud, and how well.

#include "bench/near_pairs.hpp"
#include "bench/workload.hpp"
#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace treeform::bench {

/// [V] the point that each point becomes; one that is kept becomes itself.
using weld_answer = std::vector<std::uint32_t>;

struct weld_quality {
    std::size_t kept = 0;
    std::size_t missed_pairs = 0;       ///< pairs of kept points within the tolerance
    double largest_displacement = 0.0;  ///< from a point to what it became
};
[[nodiscard]] weld_quality quality_of(const weld_answer& answer, const std::vector<point3>& points,
                                      double tolerance);

/// Times `weld(points)`; the pairs it missed are its error.
[[nodiscard]] job weld_job(const shared_cloud& cloud, double tolerance,
                           std::function<weld_answer(const std::vector<point3>&)> weld);

[[nodiscard]] weld_answer weld_by_treeform(const std::vector<point3>& points,
                                           const weld_options& options,
                                           detail::weld::neighbor_search search = {});

/// Coordinates rounded down to multiples of the tolerance, sorted, equal ones joined: the first of
/// each cube is kept.
[[nodiscard]] weld_answer weld_by_rounding(const std::vector<point3>& points, double tolerance);

inline const std::string rounding_name = "grid rounding";

}  // namespace treeform::bench
