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
    double products = 0.0, squares = 0.0, all = 0.0, weights = 0.0;
    residuals found;
    const partner* before = nullptr;
    for (const partner& p : weighed) {
        if (!(p.weight > 0.0)) continue;
        const double off = signed_distance(p);
        all += p.weight * off * off;
        weights += p.weight;
        const double facing = before != nullptr ? p.normal.dot(before->normal) : 0.0;
        if (std::abs(facing) > 0.5) {
            const double other = signed_distance(*before), weight = p.weight * before->weight;
            products += weight * (facing < 0.0 ? -off : off) * other;
            squares += weight * 0.5 * (off * off + other * other);
            ++found.pairs;
        }
        before = &p;
    }
    if (weights > 0.0) found.rms = std::sqrt(all / weights);
    if (squares > 0.0) found.correlation = products / squares;
    return found;
}

/// With x = (turn, shift), a point moves by J x: A is the mean of (n J)^T (n J), B of J^T J, and
/// the stiffnesses are the eigenvalues of A x = s B x, in [0, 1]. What B does not see is left out.
std::vector<freedom> freedoms_of(const std::vector<partner>& weighed, const Vector3d& center) {
    wide6 sums = sum_over(weighed, wide6(wide6::Zero()), [&](const partner& p) {
        const Vector3d arm = p.from - center;
        Eigen::Matrix<double, 3, 6> moves;
        moves << 0.0, arm.z(), -arm.y(), 1.0, 0.0, 0.0,  //
            -arm.z(), 0.0, arm.x(), 0.0, 1.0, 0.0,       //
            arm.y(), -arm.x(), 0.0, 0.0, 0.0, 1.0;
        const vector<6> along = moves.transpose() * p.normal;
        wide6 one;
        one.leftCols<6>() = p.weight * along * along.transpose();
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
