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
    std::size_t pairs = 0;  ///< of neighbors

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

}  // namespace treeform::detail::place
