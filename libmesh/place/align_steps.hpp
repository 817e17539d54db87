#pragma once
/// \file
/// The least squares of an alignment: from partners to the step that brings them together. What the
/// distances that remain say of it: whether they are noise, and what motions they do not tell of.

#include <libmesh/place/solvers.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace treeform::detail::place {

/// Sums are computed in blocks of this many points and added in order, so that they are the same on
/// any number of threads.
constexpr std::size_t block = 4096;

constexpr double endless = std::numeric_limits<double>::infinity();

/// The unknown of the alignment, y = scale rotation x + shift.
struct similarity {
    double scale = 1.0;
    Matrix3d rotation = Matrix3d::Identity();
    Vector3d shift = Vector3d::Zero();

    [[nodiscard]] Vector3d operator()(const Vector3d& x) const {
        return scale * (rotation * x) + shift;
    }
    [[nodiscard]] bool finite() const { return shift.allFinite() && rotation.allFinite(); }
};

/// A moved point, its nearest fixed point, and the normal of its target plane: the normal of the
/// face there; at an edge or corner the direction between the two points, oriented as the face's
/// normal.
struct partner {
    Vector3d from = Vector3d::Zero(), to = Vector3d::Zero(), normal = Vector3d::Zero();
    double distance = endless;  ///< infinite: no partner
    double weight = 0.0;        ///< 0: ignored
    double hold = 1.0;          ///< weight of the squared distance along the normal
    double slack = 0.0;         ///< weight of the squared distance across it
    double noise = 0.0;         ///< thickness of both sides here
};

/// The sum of `of(partner)` over all partners with a positive weight.
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

/// The 3x6 matrix J: the motion x = (turn, shift) moves a point at `arm` from the center of the
/// turn by J x.
[[nodiscard]] Eigen::Matrix<double, 3, 6> moves_of(const Vector3d& arm);

/// `overlap` times `count`, as a number of points; at least 1.
[[nodiscard]] std::size_t share_of(double overlap, std::size_t count);

/// Sets the weights. The nearest `count` partners (ties: the first) get 1, or, if `width` is
/// finite, the value of Welsch's function of that width; all others get 0.
void weigh(std::vector<partner>& partners, std::size_t count, double width);

/// The middle one; 0 if there is none.
[[nodiscard]] double median_of(std::vector<double> numbers);
/// The same of the distances that count.
[[nodiscard]] double median_distance(const std::vector<partner>& partners);

/// The quality of an alignment.
struct quality {
    /// Mean loss of the `count` nearest points; points without a partner count with the maximum
    /// distance. The loss is the squared distance, or Welsch's function, which is close to that
    /// near 0.
    double cost = 0.0;
    double rms = 0.0;      ///< weighted root mean square distance
    double overlap = 0.0;  ///< share of all points that have a partner
};
[[nodiscard]] quality quality_of(const std::vector<partner>& weighed, std::size_t count,
                                 double width, double max_distance);

/// The similarity that minimizes the squared distances between partners. \source Umeyama (1991),
/// equations 40 to 43
[[nodiscard]] similarity point_step(const std::vector<partner>& partners, bool scale);

/// The linearized motion (a turn, a shift, and a scaling if `scale`) that minimizes the squared
/// distances to the planes at the partners. Motions that change no distance are 0.
[[nodiscard]] similarity plane_step(const std::vector<partner>& partners, bool scale);

/// First `map`, then `step`; the rotation is orthonormalized, since rounding errors accumulate.
[[nodiscard]] similarity after(const similarity& step, const similarity& map);

/// The largest displacement of a point in a ball of radius 1 by a step.
[[nodiscard]] double displacement(const similarity& step);

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
