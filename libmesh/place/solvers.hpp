#pragma once
/// \file
/// Decompositions of small matrices, each compiled once: every decomposition of Eigen takes a
/// second to compile, and its header another second for each file.

#define EIGEN_MPL2_ONLY
#include <Eigen/Core>

namespace treeform::detail::place {

using Eigen::Matrix3d;
using Eigen::Vector3d;

template <int Size>
using vector = Eigen::Matrix<double, Size, 1>;
template <int Size>
using square = Eigen::Matrix<double, Size, Size>;

/// Eigenvalues of a symmetric matrix, ascending, and unit eigenvectors, as columns.
template <int Size>
struct eigen_system {
    vector<Size> values;
    square<Size> vectors;
};
[[nodiscard]] eigen_system<3> eigen_of(const square<3>& symmetric);
[[nodiscard]] eigen_system<6> eigen_of(const square<6>& symmetric);
[[nodiscard]] eigen_system<7> eigen_of(const square<7>& symmetric);
[[nodiscard]] eigen_system<Eigen::Dynamic> eigen_of(const Eigen::MatrixXd& symmetric);

/// Like `eigen_of`, but faster and less precise.
[[nodiscard]] eigen_system<3> eigen_in_closed_form(const Matrix3d& symmetric);

/// matrix = left diag(values) right^T; `mirrored` if left right^T is a reflection.
struct singular_system {
    Matrix3d left, right;
    Vector3d values;
    bool mirrored;
};
[[nodiscard]] singular_system singular_of(const Matrix3d& matrix);

/// Solves matrix x = right for a symmetric positive semidefinite matrix.
[[nodiscard]] vector<3> solve(const square<3>& matrix, const vector<3>& right);
[[nodiscard]] vector<5> solve(const square<5>& matrix, const vector<5>& right);

/// The x that minimizes |columns x - right|.
[[nodiscard]] Eigen::VectorXd least_squares(const Eigen::Matrix<double, 7, Eigen::Dynamic>& columns,
                                            const vector<7>& right);

[[nodiscard]] inline Vector3d cross_product(const Vector3d& a, const Vector3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] Vector3d any_orthogonal(const Vector3d& v);  ///< a unit vector
[[nodiscard]] bool is_mirrored(const Matrix3d& matrix);    ///< its determinant is negative

/// Rotation about the direction of `turn` by its length, in radians.
[[nodiscard]] Matrix3d rotation_by(const Vector3d& turn);
[[nodiscard]] Vector3d turn_of(const Matrix3d& rotation);
/// Rotation by the quaternion, of any length.
[[nodiscard]] Matrix3d rotation_of(double w, double x, double y, double z);
/// The rotation nearest to a matrix that is one up to rounding.
[[nodiscard]] Matrix3d rotation_near(const Matrix3d& matrix);

}  // namespace treeform::detail::place
