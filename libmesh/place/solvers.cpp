#include <libmesh/place/solvers.hpp>

#include <Eigen/Dense>

namespace treeform::detail::place {
namespace {

/// The solver for matrices of any size serves 6 and 7, too: each size would take 4 s to compile.
template <int Size, class Matrix>
eigen_system<Size> solved(const Matrix& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

eigen_system<3> eigen_of(const square<3>& symmetric) { return solved<3>(symmetric); }
eigen_system<6> eigen_of(const square<6>& symmetric) {
    return solved<6>(Eigen::MatrixXd(symmetric));
}
eigen_system<7> eigen_of(const square<7>& symmetric) {
    return solved<7>(Eigen::MatrixXd(symmetric));
}
eigen_system<Eigen::Dynamic> eigen_of(const Eigen::MatrixXd& symmetric) {
    return solved<Eigen::Dynamic>(symmetric);
}

eigen_system<3> eigen_in_closed_form(const Matrix3d& symmetric) {
    Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
    solver.computeDirect(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

singular_system singular_of(const Matrix3d& matrix) {
    const Eigen::JacobiSVD<Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = svd.matrixU().determinant() * svd.matrixV().determinant();
    return {svd.matrixU(), svd.matrixV(), svd.singularValues(), sign < 0.0};
}

vector<3> solve(const square<3>& matrix, const vector<3>& right) {
    return matrix.ldlt().solve(right);
}
vector<5> solve(const square<5>& matrix, const vector<5>& right) {
    return matrix.ldlt().solve(right);
}

Eigen::VectorXd least_squares(const Eigen::Matrix<double, 7, Eigen::Dynamic>& columns,
                              const vector<7>& right) {
    return columns.colPivHouseholderQr().solve(right);
}

Vector3d any_orthogonal(const Vector3d& v) { return v.unitOrthogonal(); }
bool is_mirrored(const Matrix3d& matrix) { return matrix.determinant() < 0.0; }

Matrix3d rotation_by(const Vector3d& turn) {
    const double angle = turn.norm();
    if (!(angle > 0.0)) return Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Vector3d turn_of(const Matrix3d& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    return turn.angle() * turn.axis();
}

Matrix3d rotation_of(double w, double x, double y, double z) {
    return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

Matrix3d rotation_near(const Matrix3d& matrix) {
    return Eigen::Quaterniond(matrix).normalized().toRotationMatrix();
}

}  // namespace treeform::detail::place
