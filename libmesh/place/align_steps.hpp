#pragma once
/// \file
/// The least squares of an alignment: from partners to the step that brings them together.

#include <libmesh/place/solvers.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <limits>
#include <vector>

namespace treeform::detail::place {

/// Sums are of blocks of this many points, added up in order: the same on any number of threads.
constexpr std::size_t block = 4096;

constexpr double endless = std::numeric_limits<double>::infinity();

/// What is looked for: y = scale rotation x + shift.
struct similarity {
    double scale = 1.0;
    Matrix3d rotation = Matrix3d::Identity();
    Vector3d shift = Vector3d::Zero();

    [[nodiscard]] Vector3d operator()(const Vector3d& x) const {
        return scale * (rotation * x) + shift;
    }
    [[nodiscard]] bool finite() const { return shift.allFinite() && rotation.allFinite(); }
};

/// A moved point, its nearest fixed point, and the normal of the plane it is to come to: of the
/// face there, or from an edge or corner that is nearest the direction between the two, on the side
/// of the face's normal.
struct partner {
    Vector3d from = Vector3d::Zero(), to = Vector3d::Zero(), normal = Vector3d::Zero();
    double distance = endless;  ///< of none
    double weight = 0.0;        ///< 0: does not count
    double hold = 1.0;          ///< how much the squared distance along the normal counts
    double slack = 0.0;         ///< and that across it
    double noise = 0.0;         ///< how thick both sides are here
};

/// The sum of `of(partner)` over all that count.
template <class Sum, class Of>
[[nodiscard]] Sum sum_over(const std::vector<partner>& partners, Sum zero, const Of& of) {
    std::vector<Sum> sums(chunk_count(partners.size(), block), zero);
    for_chunks(partners.size(), block, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i)
            if (partners[i].weight > 0.0) sums[chunk] += of(partners[i]);
    });
    for (const Sum& s : sums) zero += s;
    return zero;
}

/// By x = (turn, shift), a point at `arm` from the center of the turn moves by this times x.
[[nodiscard]] Eigen::Matrix<double, 3, 6> moves_of(const Vector3d& arm);

/// How many of `count` the share `overlap` is; at least 1.
[[nodiscard]] std::size_t share_of(double overlap, std::size_t count);

/// Sets the weights: of the nearest `count` partners, of equals the first, 1, or by Welsch's
/// function of this width, if it is finite; of all others 0.
void weigh(std::vector<partner>& partners, std::size_t count, double width);

/// The middle one of the distances that count; 0 if none do.
[[nodiscard]] double median_distance(const std::vector<partner>& partners);

/// How good a place is.
struct quality {
    /// Mean of the losses of the `count` nearest; those without a partner are at the largest
    /// distance allowed. The loss is the square of a distance, or Welsch's, about as much near 0.
    double cost = 0.0;
    double rms = 0.0;      ///< of the distances that count, by weight
    double overlap = 0.0;  ///< share of all that have a partner
};
[[nodiscard]] quality quality_of(const std::vector<partner>& weighed, std::size_t count,
                                 double width, double max_distance);

/// Least squares of the distances between partners. \source Umeyama (1991), equations 40 to 43
[[nodiscard]] similarity point_step(const std::vector<partner>& partners, bool scale);

/// Least squares of the distances to the planes at the partners, of a motion taken as linear: a
/// turn, a shift, and a growth if `scale`. Directions that change no distance stay as they are.
[[nodiscard]] similarity plane_step(const std::vector<partner>& partners, bool scale);

/// First `map`, then `step`; the rotation is made one again, since roundings add up.
[[nodiscard]] similarity after(const similarity& step, const similarity& map);

/// How far a step moves the points of a ball of radius 1, at most.
[[nodiscard]] double displacement(const similarity& step);

}  // namespace treeform::detail::place
