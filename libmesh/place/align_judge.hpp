#pragma once
/// \file
/// What the distances that remain say of an alignment: whether they are noise, and what motions
/// they do not tell of.

#include <libmesh/place/align_steps.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace treeform::detail::place {

/// The signed distances to the planes at the partners that count.
struct residuals {
    /// Of neighbors: products over squares, in [-1, 1]; 0 without neighbors.
    double correlation = 0.0;
    double rms = 0.0;
    double noise = 0.0;     ///< how thick both sides are: root mean square; 0 of meshes
    std::size_t pairs = 0;  ///< of neighbors
    double points = 0.0;    ///< that count, by weight

    /// Root mean square of the part that neighbors have in common.
    [[nodiscard]] double common() const;
};

/// Partners in an order of space: those next to each other in it, on surfaces that face the same
/// way or the opposite one, are neighbors.
[[nodiscard]] residuals residuals_of(const std::vector<partner>& weighed);

/// A turn about `center`, and a shift, that move the partners by 1 in the root mean square.
struct freedom {
    Vector3d turn = Vector3d::Zero();
    Vector3d shift = Vector3d::Zero();
    double stiffness = 0.0;  ///< the share of that, squared, that is along the normals
};

/// The six independent motions, least stiff first; fewer where points cannot show the turn, as
/// about a line on which they all are; none without partners.
[[nodiscard]] std::vector<freedom> freedoms_of(const std::vector<partner>& weighed,
                                               const Vector3d& center);

/// How far the points may be from where they belong: the standard deviation that the distances
/// leave, as a root mean square over the points. Neighbors that are off to the same side count as
/// fewer. Motions of a stiffness below `least` are left out.
[[nodiscard]] double uncertainty_of(const residuals& left, const std::vector<freedom>& freedoms,
                                    double least);

/// Every fourth of the points is not fitted, where there are many: they are what a fit is judged
/// by.
constexpr std::size_t judge_every = 4;
[[nodiscard]] inline bool is_judge(std::size_t i) { return i % judge_every == judge_every / 2; }

/// Those of the partners.
[[nodiscard]] std::vector<partner> judges_among(const std::vector<partner>& weighed);

/// How far the judges alone would move all of them: root mean square. 0 where none counts.
[[nodiscard]] double move_by(const std::vector<partner>& judges, bool scale);

}  // namespace treeform::detail::place
