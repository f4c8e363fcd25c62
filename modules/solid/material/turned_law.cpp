#include "modules/solid/material/turned_law.hpp"

#include <Eigen/Dense>

namespace perifrac {

namespace {

using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// The rotation that is next to f, by its singular values: of any f, though not the only one where
/// two of them are 0.
Matrix rotation_by_singular_values(const Matrix& f) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(Eigen::Matrix3d(f),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d &u = parts.matrixU(), &v = parts.matrixV();
  const double sign = u.determinant() * v.determinant() < 0.0 ? -1.0 : 1.0;
  return u * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * v.transpose();
}

/// f^-T times det f.
Matrix cofactors(const Matrix& f) {
  Matrix result;
  result.row(0) = f.row(1).cross(f.row(2));
  result.row(1) = f.row(2).cross(f.row(0));
  result.row(2) = f.row(0).cross(f.row(1));
  return result;
}

// Of det F over (|F|^2 / 3)^1.5, which is 1 of a rotation: below it Newton's iteration is slow.
constexpr double collapsed = 1e-2;

/// Newton's iteration X <- (X + X^-T) / 2 doubles the right digits at every turn.
Matrix rotation_of(const Matrix& f) {
  const double size = std::sqrt(f.squaredNorm() / 3.0);
  if (!std::isfinite(size)) return f;  // the steps' own check says where
  Matrix x = f;
  Matrix inverse = cofactors(x);
  double determinant = x.row(0).dot(inverse.row(0));
  if (!(determinant > collapsed * size * size * size)) return rotation_by_singular_values(f);
  for (int n = 0; n < 30; ++n) {
    const Matrix change = 0.5 * (inverse / determinant - x);
    x += change;
    if (change.squaredNorm() < 1e-18) break;  // what is left of its error is the square of this
    inverse = cofactors(x);
    determinant = x.row(0).dot(inverse.row(0));
  }
  return x;
}

}  // namespace

Turned<3> turned(const Tensor<3, 3>& gradient) {
  const Eigen::Map<const Matrix> g(gradient.data());
  const Matrix rotation = rotation_of(Matrix::Identity() + g);
  const Matrix back = rotation.transpose();
  const Matrix strain = back * g + (back - Matrix::Identity());
  Turned<3> result;
  Eigen::Map<Matrix>(result.rotation.data()) = rotation;
  Eigen::Map<Matrix>(result.strain.data()) = 0.5 * (strain + strain.transpose());
  return result;
}

}  // namespace perifrac
