#pragma once

#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "core/solvers/sparse_cholesky.hpp"
#include "core/time/ode_system.hpp"
#include "modules/pore_flow/darcy_system.hpp"

namespace perifrac {

/// I - gamma J of Darcy flow by way of the symmetric V S + gamma H in the potential. For a
/// compressible fluid S follows the pressure and H is that of no pressure.
///
/// Directly, H is assembled, anew where bonds broke or storage is another, and factored. As a
/// preconditioner, the bonds' own part of the flow stands in for H, with a third of the entries and
/// the same spectrum up to a factor, and what points store by themselves for S: solved for by
/// conjugate gradients with an incomplete factor, for a whole one fills up. Either way the solution
/// is put together from fluxes between points and faces, so that no volume is lost whatever the
/// accuracy of the solve.
template <int D>
class DarcyNewtonMatrix final : public NewtonMatrix {
 public:
  enum class Method { direct, preconditioner };

  /// The system must outlive the matrix.
  DarcyNewtonMatrix(DarcySystem<D>& system, Method method);

  bool exact() const override { return method_ == Method::direct; }
  void set_up(double t, std::span<const double> y, double gamma) override;
  void solve(std::span<const double> r, std::span<double> solution) override;

 private:
  using Iteration = Eigen::ConjugateGradient<
      Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
      Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>;

  void assemble();
  /// Leaves nothing in the matrix's row and column of a point whose pressure is held.
  void uncouple(Index i);

  DarcySystem<D>& system_;
  Method method_;
  std::uint64_t pattern_version_ = 0;      ///< of what is assembled; 0: nothing yet
  Eigen::SparseMatrix<double> flow_;       ///< H or what stands in for it
  Eigen::SparseMatrix<double> face_flow_;  ///< its rows of the faces
  Eigen::SparseMatrix<double> matrix_;     ///< V S + gamma H
  SparseCholesky factor_;
  Iteration iteration_;
  double gamma_ = 0.0;
  Eigen::VectorXd right_side_;
  Eigen::VectorXd pressure_;
  Eigen::VectorXd outflow_;
  Eigen::VectorXd face_outflow_;
};

}  // namespace perifrac
