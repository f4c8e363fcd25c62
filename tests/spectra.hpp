#pragma once

#include <Eigen/Core>

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac::test {

/// Eigenvalues of any square matrix. Compiled once, as symmetric_spectrum() is.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// Of A x = value B x, both symmetric, B positive definite, with x^T B x = 1.
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace perifrac::test
