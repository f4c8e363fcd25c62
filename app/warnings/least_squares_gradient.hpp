#pragma once

#include <Eigen/Dense>

namespace perifrac {

/// The gradient of a vector at a point, from how it differs at neighbours: exact where the vector
/// is linear, by least squares elsewhere.
template <int D>
class LeastSquaresGradient {
 public:
  using Column = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// At the end of `bond` the vector is larger by `apart`.
  void add(const Column& bond, const Column& apart, double weight = 1.0) {
    shape_ += weight * bond * bond.transpose();
    spread_ += weight * apart * bond.transpose();
  }

  /// 0 where bonds in one line say nothing across it.
  Matrix matrix() const {
    const Eigen::FullPivLU<Matrix> factor(shape_);
    if (!factor.isInvertible()) return Matrix::Zero();
    return spread_ * factor.inverse();
  }

 private:
  Matrix shape_ = Matrix::Zero();
  Matrix spread_ = Matrix::Zero();
};

}  // namespace perifrac
