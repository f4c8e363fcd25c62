#pragma once

#include <Eigen/Core>

namespace perifrac {

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors as columns. Compiled once: the
/// solvers are the dearest templates that we use.
template <int N>
struct SpectrumOf {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};
using SymmetricSpectrum = SpectrumOf<Eigen::Dynamic>;

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);
template <int N>  // 2 and 3
SpectrumOf<N> symmetric_spectrum(const Eigen::Matrix<double, N, N>& matrix);

}  // namespace perifrac
