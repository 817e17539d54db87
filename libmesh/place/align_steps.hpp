#pragma once
/// \file
/// The least squares of an alignment: from partners to the step that brings them together.

#include <treeform/tree/parallel.hpp>

#define EIGEN_MPL2_ONLY
#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace treeform::detail::place {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sums are of blocks of this many points, added up in order: the same on any number of threads.
constexpr std::size_t block = 4096;

/// What is looked for: y = scale rotation x + shift.
struct similarity {
    double scale = 1.0;
    Matrix3d rotation = Matrix3d::Identity();
    Vector3d shift = Vector3d::Zero();

    [[nodiscard]] Vector3d operator()(const Vector3d& x) const {
        return scale * (rotation * x) + shift;
    }
};

/// A moved point, its nearest fixed point, and the normal of the plane it is to come to: of the
/// face there, or from an edge or corner that is nearest the direction to the moved point.
struct partner {
    Vector3d from, to, normal;
    double distance;
    std::size_t number;
};

/// The sum of `of(partner)` over all.
template <class Sum, class Of>
[[nodiscard]] Sum sum_over(const std::vector<partner>& partners, Sum zero, const Of& of) {
    std::vector<Sum> sums(chunk_count(partners.size(), block), zero);
    for_chunks(partners.size(), block, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i) sums[chunk] += of(partners[i]);
    });
    for (const Sum& s : sums) zero += s;
    return zero;
}

/// How many of `count` the share `overlap` is; at least 1.
[[nodiscard]] std::size_t share_of(double overlap, std::size_t count);

/// Leaves the nearest `count` partners, in the order of their points; of equals the first.
void trim(std::vector<partner>& partners, std::size_t count);

/// Least squares of the distances between partners. \source Umeyama (1991), equations 40 to 43
[[nodiscard]] similarity point_step(const std::vector<partner>& partners, bool scale);

/// Least squares of the distances to the planes at the partners, of a motion taken as linear: a
/// turn, a shift, and a growth if `scale`. Directions that change no distance stay as they are.
[[nodiscard]] similarity plane_step(const std::vector<partner>& partners, bool scale);

/// First `map`, then `step`; the rotation is made one again, since roundings add up.
[[nodiscard]] similarity after(const similarity& step, const similarity& map);

}  // namespace treeform::detail::place
