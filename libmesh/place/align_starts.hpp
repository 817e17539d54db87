#pragma once
/// \file
/// Starts of an alignment, and the selection of promising ones.

#include <libmesh/place/align_judge.hpp>
#include <libmesh/place/align_search.hpp>
#include <libmesh/place/align_steps.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform::detail::place {

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
/// number. Stops early, with the results so far, when `go_on` returns false.
[[nodiscard]] std::vector<tried_start> try_starts(const search_task& task, const moving_points& few,
                                                  std::span<const similarity> starts,
                                                  function_ref<bool(std::size_t)> go_on);

}  // namespace treeform::detail::place
