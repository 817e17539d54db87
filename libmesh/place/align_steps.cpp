#include <libmesh/place/align_steps.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform::detail::place {
namespace {

Vector3d mean(const std::vector<partner>& partners, Vector3d partner::*of) {
    const Vector3d sum =
        sum_over(partners, Vector3d(Vector3d::Zero()), [of](const partner& p) { return p.*of; });
    return sum / static_cast<double>(partners.size());
}

/// A step about a center: y' = center + scale rotation (y - center) + shift.
similarity about(const Vector3d& center, similarity step) {
    step.shift += center - step.scale * (step.rotation * center);
    return step;
}

using row7 = Eigen::Matrix<double, 7, 1>;
using system7 = Eigen::Matrix<double, 7, 8>;

}  // namespace

std::size_t share_of(double overlap, std::size_t count) {
    return std::max<std::size_t>(
        static_cast<std::size_t>(std::ceil(overlap * static_cast<double>(count) - 1e-9)), 1);
}

void trim(std::vector<partner>& partners, std::size_t count) {
    if (partners.size() <= count) return;
    std::nth_element(partners.begin(), partners.begin() + static_cast<std::ptrdiff_t>(count),
                     partners.end(), [](const partner& a, const partner& b) {
                         return std::pair(a.distance, a.number) < std::pair(b.distance, b.number);
                     });
    partners.resize(count);
    std::sort(partners.begin(), partners.end(),
              [](const partner& a, const partner& b) { return a.number < b.number; });
}

similarity point_step(const std::vector<partner>& partners, bool scale) {
    const Vector3d from = mean(partners, &partner::from), to = mean(partners, &partner::to);
    Eigen::Matrix<double, 3, 4> sums = Eigen::Matrix<double, 3, 4>::Zero();
    sums = sum_over(partners, sums, [&](const partner& p) {
        Eigen::Matrix<double, 3, 4> one = Eigen::Matrix<double, 3, 4>::Zero();
        one.leftCols<3>() = (p.to - to) * (p.from - from).transpose();
        one(0, 3) = (p.from - from).squaredNorm();
        return one;
    });
    const Eigen::JacobiSVD<Matrix3d> svd(sums.leftCols<3>(),
                                         Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vector3d signs(1.0, 1.0, 1.0);  // else flat points may come out mirrored
    if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
    similarity step;
    step.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    if (scale && sums(0, 3) > 0.0) step.scale = svd.singularValues().dot(signs) / sums(0, 3);
    step.shift = to - from;
    return about(from, step);
}

similarity plane_step(const std::vector<partner>& partners, bool scale) {
    const Vector3d center = mean(partners, &partner::from);
    const system7 sums = sum_over(partners, system7(system7::Zero()), [&](const partner& p) {
        const Vector3d arm = p.from - center;
        row7 row;
        row << arm.cross(p.normal), p.normal, scale ? arm.dot(p.normal) : 0.0;
        system7 one;
        one.leftCols<7>() = row * row.transpose();
        one.col(7) = row * (p.to - p.from).dot(p.normal);
        return one;
    });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 7, 7>> solver(sums.leftCols<7>());
    const row7& values = solver.eigenvalues();
    const row7 along = solver.eigenvectors().transpose() * sums.col(7);
    row7 x = row7::Zero();
    for (int i = 0; i < 7; ++i)
        if (values(i) > 1e-10 * values(6)) x += along(i) / values(i) * solver.eigenvectors().col(i);
    similarity step;
    const Vector3d turn = x.head<3>();
    const double angle = turn.norm();
    if (angle > 0.0) step.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    step.shift = x.segment<3>(3);
    step.scale = std::max(1.0 + x(6), 0.1);
    return about(center, step);
}

similarity after(const similarity& step, const similarity& map) {
    similarity both;
    both.scale = step.scale * map.scale;
    both.rotation =
        Eigen::Quaterniond(step.rotation * map.rotation).normalized().toRotationMatrix();
    both.shift = step(map.shift);
    return both;
}

}  // namespace treeform::detail::place
