#include "core/solvers/symmetric_spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace perifrac {

template <int N>
SpectrumOf<N> symmetric_spectrum(const Eigen::Matrix<double, N, N>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix) {
  return symmetric_spectrum<Eigen::Dynamic>(matrix);
}

template SpectrumOf<2> symmetric_spectrum(const Eigen::Matrix2d&);
template SpectrumOf<3> symmetric_spectrum(const Eigen::Matrix3d&);

}  // namespace perifrac
