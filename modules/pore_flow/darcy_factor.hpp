#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/solvers/sparse_cholesky.hpp"
#include "core/time/ode_system.hpp"
#include "modules/pore_flow/darcy_system.hpp"

namespace perifrac {

/// The inverse of I - gamma J of Darcy flow by a factor of the symmetric V S + gamma H in the
/// potential, assembled anew where bonds broke or storage is another. For a compressible fluid S
/// follows the pressure and H is that of no pressure. The solution is put together from fluxes
/// between points and faces, so that no volume is lost.
template <int D>
class DarcyFactor final : public NewtonMatrix {
 public:
  /// The system must outlive the matrix.
  explicit DarcyFactor(DarcySystem<D>& system);

  bool exact() const override { return true; }
  void set_up(double t, std::span<const double> y, double gamma) override;
  void solve(std::span<const double> r, std::span<double> solution) override;

 private:
  void assemble();
  /// Leaves nothing in the matrix's row and column of a point whose pressure is held.
  void uncouple(Index i);

  DarcySystem<D>& system_;
  std::uint64_t pattern_version_ = 0;      ///< of what is assembled; 0: nothing yet
  Eigen::SparseMatrix<double> flow_;       ///< H
  Eigen::SparseMatrix<double> face_flow_;  ///< its rows of the faces
  Eigen::SparseMatrix<double> matrix_;     ///< V S + gamma H
  SparseCholesky factor_;
  double gamma_ = 0.0;
  Eigen::VectorXd right_side_;
  Eigen::VectorXd pressure_;
  Eigen::VectorXd outflow_;
  Eigen::VectorXd face_outflow_;
};

}  // namespace perifrac
