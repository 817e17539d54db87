#include <libmesh/place/align_judge.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::place {
namespace {

using wide6 = Eigen::Matrix<double, 6, 12>;

double signed_distance(const partner& p) { return (p.from - p.to).dot(p.normal); }

}  // namespace

double residuals::common() const { return rms * std::sqrt(std::max(correlation, 0.0)); }

residuals residuals_of(const std::vector<partner>& weighed) {
    double products = 0.0, squares = 0.0, all = 0.0, noise = 0.0, weights = 0.0;
    residuals found;
    const partner* before = nullptr;
    for (const partner& p : weighed) {
        if (!(p.weight * p.hold > 0.0)) continue;
        const double off = signed_distance(p), counts = p.weight * p.hold;
        all += counts * off * off;
        noise += counts * p.noise * p.noise;
        weights += counts;
        const double facing = before != nullptr ? p.normal.dot(before->normal) : 0.0;
        if (std::abs(facing) > 0.5) {
            const double other = signed_distance(*before),
                         weight = counts * before->weight * before->hold;
            products += weight * (facing < 0.0 ? -off : off) * other;
            squares += weight * 0.5 * (off * off + other * other);
            ++found.pairs;
        }
        before = &p;
    }
    if (weights > 0.0) {
        found.rms = std::sqrt(all / weights);
        found.noise = std::sqrt(noise / weights);
    }
    found.points = weights;
    if (squares > 0.0) found.correlation = products / squares;
    return found;
}

double uncertainty_of(const residuals& left, const std::vector<freedom>& freedoms, double least) {
    const double shared = std::clamp(left.correlation, 0.0, 0.99);
    double sum = 0.0;
    for (const freedom& one : freedoms)
        if (one.stiffness >= least) sum += 1.0 / one.stiffness;
    if (!(sum > 0.0 && left.points > 0.0)) return 0.0;
    return left.rms * std::sqrt(sum / left.points * (1.0 + shared) / (1.0 - shared));
}

std::vector<partner> judges_among(const std::vector<partner>& weighed) {
    std::vector<partner> judges;
    for (std::size_t i = 0; i < weighed.size(); ++i)
        if (is_judge(i)) judges.push_back(weighed[i]);
    return judges;
}

double move_by(const std::vector<partner>& judges, bool scale) {
    const double weights = sum_over(judges, 0.0, [](const partner& p) { return p.weight; });
    if (!(weights > 0.0)) return 0.0;
    const similarity step = plane_step(judges, scale);
    const double moved = sum_over(judges, 0.0, [&](const partner& p) {
        return p.weight * (step(p.from) - p.from).squaredNorm();
    });
    return std::sqrt(moved / weights);
}

/// With x = (turn, shift), a point moves by J x: A is the mean of (n J)^T (n J), B of J^T J, and
/// the stiffnesses are the eigenvalues of A x = s B x, in [0, 1]. What B does not see is left out.
std::vector<freedom> freedoms_of(const std::vector<partner>& weighed, const Vector3d& center) {
    wide6 sums = sum_over(weighed, wide6(wide6::Zero()), [&](const partner& p) {
        const Eigen::Matrix<double, 3, 6> moves = moves_of(p.from - center);
        const vector<6> along = moves.transpose() * p.normal;
        wide6 one;
        one.leftCols<6>() = p.weight * p.hold * along * along.transpose();
        one.rightCols<6>() = p.weight * moves.transpose() * moves;
        return one;
    });
    const double weights = sum_over(weighed, 0.0, [](const partner& p) { return p.weight; });
    if (!(weights > 0.0)) return {};
    sums /= weights;
    const eigen_system<6> seen = eigen_of(square<6>(sums.rightCols<6>()));
    const int first =
        static_cast<int>(std::count_if(seen.values.begin(), seen.values.end(),
                                       [&](double v) { return v <= 1e-10 * seen.values(5); }));
    // The motions as columns, each by 1.
    Eigen::MatrixXd motions = seen.vectors.rightCols(6 - first);
    for (int i = first; i < 6; ++i) motions.col(i - first) /= std::sqrt(seen.values(i));
    const eigen_system<Eigen::Dynamic> held =
        eigen_of(Eigen::MatrixXd(motions.transpose() * sums.leftCols<6>() * motions));
    std::vector<freedom> found;
    for (int i = 0; i < 6 - first; ++i) {
        const Eigen::VectorXd motion = motions * held.vectors.col(i);
        found.push_back({motion.head<3>(), motion.tail<3>(), std::clamp(held.values(i), 0.0, 1.0)});
    }
    return found;
}

}  // namespace treeform::detail::place
