#include "core/solvers/symmetric_spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace perifrac {

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace perifrac
