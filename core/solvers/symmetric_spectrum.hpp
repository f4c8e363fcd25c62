#pragma once

#include <Eigen/Core>

namespace perifrac {

/// Eigenvalues of a symmetric matrix, rising, and its eigenvectors as columns. Compiled once: the
/// solver is the dearest template that we use.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);

}  // namespace perifrac
