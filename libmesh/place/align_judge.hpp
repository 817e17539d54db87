#pragma once
/// \file
/// Assesses an alignment by its residual distances: whether they are noise, and which motions they
/// do not constrain.

#include <libmesh/place/align_steps.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace treeform::detail::place {

/// Statistics of the signed distances to the planes at the partners with a positive weight.
struct residuals {
    /// Correlation of the distances of neighbors, in [-1, 1]; 0 without neighbors.
    double correlation = 0.0;
    double rms = 0.0;
    double noise = 0.0;     ///< root mean square thickness of both sides; 0 for meshes
    std::size_t pairs = 0;  ///< pairs of neighbors
    double points = 0.0;    ///< sum of the weights

    /// Root mean square of the part of the distances that is common to neighbors.
    [[nodiscard]] double common() const;
};

/// `weighed` are partners in a spatial order: consecutive ones are neighbors if their normals point
/// about the same way or about opposite ways.
[[nodiscard]] residuals residuals_of(const std::vector<partner>& weighed);

/// A turn about `center` and a shift, together scaled to move the partners by a root mean square of
/// 1.
struct freedom {
    Vector3d turn = Vector3d::Zero();
    Vector3d shift = Vector3d::Zero();
    double stiffness = 0.0;  ///< share of the squared motion along the normals, in [0, 1]
};

/// The six independent motions, by ascending stiffness. Fewer if a turn moves no point, such as one
/// about a line through all points; none without partners.
[[nodiscard]] std::vector<freedom> freedoms_of(const std::vector<partner>& weighed,
                                               const Vector3d& center);

/// The uncertainty of the alignment: the standard deviation of the point positions that the
/// residuals imply, as a root mean square over the points. Correlated residuals of neighbors count
/// as fewer samples. Motions with a stiffness below `least` are excluded.
[[nodiscard]] double uncertainty_of(const residuals& left, const std::vector<freedom>& freedoms,
                                    double least);

/// If there are many points, every fourth one is excluded from the fit, to validate it (a judge).
constexpr std::size_t judge_every = 4;
[[nodiscard]] inline bool is_judge(std::size_t i) { return i % judge_every == judge_every / 2; }

/// The partners of the judges.
[[nodiscard]] std::vector<partner> judges_among(const std::vector<partner>& weighed);

/// The root mean square motion of the judges in a step fitted to the judges alone; 0 if their
/// weights are all 0.
[[nodiscard]] double move_by(const std::vector<partner>& judges, bool scale);

}  // namespace treeform::detail::place
