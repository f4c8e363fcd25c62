#pragma once

#include "tests/spectra.hpp"

namespace perifrac::test {

/// The solution of A p' = -B p at time t, A and B symmetric and positive definite, exact in time:
/// what the tests hold the series to, cell by cell and without any of their modes.
class SemiDiscrete {
 public:
  SemiDiscrete(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& start)
      : modes_(symmetric_spectrum(b, a)), amplitude_(modes_.vectors.transpose() * a * start) {}

  Eigen::VectorXd at(double t) const {
    const Eigen::VectorXd decay = (-t * modes_.values.array()).exp();
    return modes_.vectors * (decay.array() * amplitude_.array()).matrix();
  }

 private:
  SymmetricSpectrum modes_;
  Eigen::VectorXd amplitude_;
};

/// Adds a conductance between cells i and j to B.
inline void add_flow(Eigen::MatrixXd& b, int i, int j, double conductance) {
  b(i, i) += conductance;
  b(j, j) += conductance;
  b(i, j) -= conductance;
  b(j, i) -= conductance;
}

}  // namespace perifrac::test
