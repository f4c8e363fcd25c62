#include "tests/unit/time/line_diffusion.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <Eigen/Eigenvalues>

namespace perifrac::test {

double LineDiffusion::stable_step() {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(dense_jacobian(), false);
  return 2.0 / -solver.eigenvalues().real().minCoeff();
}

std::vector<double> LineDiffusion::exact(std::span<const double> y, double t) {
  const auto n = static_cast<Eigen::Index>(size());
  std::vector<double> zero(size(), 0.0), at_one(size());
  flow(zero, 1.0, at_one);  // the rate at y = 0 grows in proportion to t
  Eigen::MatrixXd carried = Eigen::MatrixXd::Zero(n + 2, n + 2);
  carried.topLeftCorner(n, n) = dense_jacobian();
  carried.col(n + 1).head(n) = Eigen::Map<Eigen::VectorXd>(at_one.data(), n);
  carried(n + 1, n) = 1.0;
  Eigen::VectorXd begin = Eigen::VectorXd::Zero(n + 2);
  begin.head(n) = Eigen::Map<const Eigen::VectorXd>(y.data(), n);
  begin[n] = 1.0;
  const Eigen::MatrixXd propagator = (carried * t).exp();
  const Eigen::VectorXd end = propagator * begin;
  return {end.data(), end.data() + n};
}

}  // namespace perifrac::test
