#pragma once
/// \file
/// Decompositions of small matrices, each compiled once: Eigen's cost a second of compiling apiece,
/// and with the header of them all another one for each file.

#define EIGEN_MPL2_ONLY
#include <Eigen/Core>

namespace treeform::detail::place {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int Size>
using vector = Eigen::Matrix<double, Size, 1>;
template <int Size>
using square = Eigen::Matrix<double, Size, Size>;

/// Of a symmetric matrix: values ascend, vectors are the columns, of length 1.
template <int Size>
struct eigen_system {
    vector<Size> values;
    square<Size> vectors;
};
[[nodiscard]] eigen_system<3> eigen_of(const square<3>& symmetric);
[[nodiscard]] eigen_system<6> eigen_of(const square<6>& symmetric);
[[nodiscard]] eigen_system<7> eigen_of(const square<7>& symmetric);
[[nodiscard]] eigen_system<Eigen::Dynamic> eigen_of(const Eigen::MatrixXd& symmetric);

/// Faster, and less precise.
[[nodiscard]] eigen_system<3> eigen_in_closed_form(const Matrix3d& symmetric);

/// matrix = left diag(values) right^T; `mirrored` if left right^T is no rotation.
struct singular_system {
    Matrix3d left, right;
    Vector3d values;
    bool mirrored;
};
[[nodiscard]] singular_system singular_of(const Matrix3d& matrix);

/// x of matrix x = right, for a matrix that is symmetric and positive semidefinite.
[[nodiscard]] vector<3> solve(const square<3>& matrix, const vector<3>& right);
[[nodiscard]] vector<5> solve(const square<5>& matrix, const vector<5>& right);

/// The x for which |columns x - right| is least.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::Matrix<double, 7, Eigen::Dynamic>& columns,
                                            const vector<7>& right);

[[nodiscard]] inline Vector3d cross_product(const Vector3d& a, const Vector3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] Vector3d any_orthogonal(const Vector3d& v);  ///< of length 1
[[nodiscard]] bool is_mirrored(const Matrix3d& matrix);    ///< its determinant is negative

/// About the direction of `turn`, by its length as an angle.
[[nodiscard]] Matrix3d rotation_by(const Vector3d& turn);
[[nodiscard]] Vector3d turn_of(const Matrix3d& rotation);
/// Of a quaternion of any length.
[[nodiscard]] Matrix3d rotation_of(double w, double x, double y, double z);
/// A rotation again, of one with roundings.
[[nodiscard]] Matrix3d rotation_near(const Matrix3d& matrix);

}  // namespace treeform::detail::place
