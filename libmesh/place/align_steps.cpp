#include <libmesh/base/for_numbers.hpp>
#include <libmesh/place/align_steps.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform::detail::place {
namespace {

double total_weight(const std::vector<partner>& partners) {
    return sum_over(partners, 0.0, [](const partner& p) { return p.weight; });
}

Vector3d mean(const std::vector<partner>& partners, Vector3d partner::*of) {
    const Vector3d sum = sum_over(partners, Vector3d(Vector3d::Zero()),
                                  [of](const partner& p) { return Vector3d(p.weight * p.*of); });
    return sum / total_weight(partners);
}

/// Of a squared distance. \source Zhang, Yao and Deng (2022), equation 5, times 2 width^2
double loss(double squared, double width) {
    if (!(width < endless)) return squared;
    const double twice = 2.0 * width * width;
    return -twice * std::expm1(-squared / twice);
}

/// A step about a center: y' = center + scale rotation (y - center) + shift.
similarity about(const Vector3d& center, similarity step) {
    step.shift += center - step.scale * (step.rotation * center);
    return step;
}

using system7 = Eigen::Matrix<double, 7, 8>;

using wide6 = Eigen::Matrix<double, 6, 12>;

double signed_distance(const partner& p) { return (p.from - p.to).dot(p.normal); }

}  // namespace

Eigen::Matrix<double, 3, 6> moves_of(const Vector3d& arm) {
    Eigen::Matrix<double, 3, 6> moves;
    moves << 0.0, arm.z(), -arm.y(), 1.0, 0.0, 0.0,  //
        -arm.z(), 0.0, arm.x(), 0.0, 1.0, 0.0,       //
        arm.y(), -arm.x(), 0.0, 0.0, 0.0, 1.0;
    return moves;
}

std::size_t share_of(double overlap, std::size_t count) {
    return std::max<std::size_t>(
        static_cast<std::size_t>(std::ceil(overlap * static_cast<double>(count) - 1e-9)), 1);
}

void weigh(std::vector<partner>& partners, std::size_t count, double width) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < partners.size(); ++i)
        if (partners[i].distance < endless) order.emplace_back(partners[i].distance, i);
    std::pair<double, std::size_t> last(endless, 0);
    if (count < order.size()) {
        const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
        std::nth_element(order.begin(), end, order.end());
        last = *end;
    }
    const double per = width < endless ? -0.5 / (width * width) : 0.0;
    base::for_numbers(partners.size(), block, [&](std::size_t i) {
        partner& p = partners[i];
        const bool counts = p.distance < endless && std::pair(p.distance, i) < last;
        p.weight = counts ? std::exp(per * p.distance * p.distance) : 0.0;
    });
}

double median_of(std::vector<double> numbers) {
    if (numbers.empty()) return 0.0;
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

double median_distance(const std::vector<partner>& partners) {
    std::vector<double> distances;
    for (const partner& p : partners)
        if (p.weight > 0.0) distances.push_back(p.distance);
    return median_of(std::move(distances));
}

quality quality_of(const std::vector<partner>& weighed, std::size_t count, double width,
                   double max_distance) {
    using Eigen::Vector4d;
    const Vector4d sums = sum_over(weighed, Vector4d(Vector4d::Zero()), [&](const partner& p) {
        const double squared = p.distance * p.distance;
        return Vector4d(loss(squared, width), p.weight * squared, p.weight, 1.0);
    });
    const auto found = std::count_if(weighed.begin(), weighed.end(),
                                     [](const partner& p) { return p.distance < endless; });
    quality q;
    q.overlap = static_cast<double>(found) / static_cast<double>(weighed.size());
    if (sums(2) > 0.0) q.rms = std::sqrt(sums(1) / sums(2));
    // What is so far away that its weight is 0 counts like what has no partner.
    const double missing = static_cast<double>(count) - sums(3);
    const double most =
        width < endless ? loss(max_distance * max_distance, width) : max_distance * max_distance;
    q.cost = (sums(0) + (missing > 0.0 ? missing * most : 0.0)) / static_cast<double>(count);
    return q;
}

similarity point_step(const std::vector<partner>& partners, bool scale) {
    const Vector3d from = mean(partners, &partner::from), to = mean(partners, &partner::to);
    Eigen::Matrix<double, 3, 4> sums = Eigen::Matrix<double, 3, 4>::Zero();
    sums = sum_over(partners, sums, [&](const partner& p) {
        Eigen::Matrix<double, 3, 4> one = Eigen::Matrix<double, 3, 4>::Zero();
        one.leftCols<3>() = p.weight * (p.to - to) * (p.from - from).transpose();
        one(0, 3) = p.weight * (p.from - from).squaredNorm();
        return one;
    });
    const singular_system svd = singular_of(sums.leftCols<3>());
    Vector3d signs(1.0, 1.0, 1.0);  // else flat points may come out mirrored
    if (svd.mirrored) signs.z() = -1.0;
    similarity step;
    step.rotation = svd.left * signs.asDiagonal() * svd.right.transpose();
    if (scale && sums(0, 3) > 0.0) step.scale = svd.values.dot(signs) / sums(0, 3);
    step.shift = to - from;
    return about(from, step);
}

similarity plane_step(const std::vector<partner>& partners, bool scale) {
    const Vector3d center = mean(partners, &partner::from);
    const system7 sums = sum_over(partners, system7(system7::Zero()), [&](const partner& p) {
        const Vector3d arm = p.from - center;
        vector<7> row;
        row << cross_product(arm, p.normal), p.normal, scale ? arm.dot(p.normal) : 0.0;
        system7 one;
        const double along = p.weight * (p.hold - p.slack);
        one.leftCols<7>() = along * row * row.transpose();
        one.col(7) = along * row * (p.to - p.from).dot(p.normal);
        if (p.slack > 0.0) {
            Eigen::Matrix<double, 3, 7> moves;
            moves << moves_of(arm), scale ? arm : Vector3d(Vector3d::Zero());
            one.leftCols<7>() += p.weight * p.slack * moves.transpose() * moves;
            one.col(7) += p.weight * p.slack * moves.transpose() * (p.to - p.from);
        }
        return one;
    });
    const auto [values, vectors] = eigen_of(square<7>(sums.leftCols<7>()));
    const vector<7> along = vectors.transpose() * sums.col(7);
    vector<7> x = vector<7>::Zero();
    for (int i = 0; i < 7; ++i)
        if (values(i) > 1e-10 * values(6)) x += along(i) / values(i) * vectors.col(i);
    similarity step;
    step.rotation = rotation_by(x.head<3>());
    step.shift = x.segment<3>(3);
    step.scale = std::max(1.0 + x(6), 0.1);
    return about(center, step);
}

similarity after(const similarity& step, const similarity& map) {
    similarity both;
    both.scale = step.scale * map.scale;
    both.rotation = rotation_near(step.rotation * map.rotation);
    both.shift = step(map.shift);
    return both;
}

double displacement(const similarity& step) {
    return (step.scale * step.rotation - Matrix3d::Identity()).norm() + step.shift.norm();
}

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
