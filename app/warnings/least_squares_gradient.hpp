#pragma once

#include <Eigen/Dense>

#include "core/solvers/symmetric_spectrum.hpp"

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
    const auto spread = symmetric_spectrum(shape_).values;
    if (!(spread[0] > in_one_line * spread[D - 1])) return Matrix::Zero();
    return spread_ * shape_.inverse();
  }

 private:
  static constexpr double in_one_line = 1e-12;  ///< that is rounding

  Matrix shape_ = Matrix::Zero();
  Matrix spread_ = Matrix::Zero();
};

}  // namespace perifrac
