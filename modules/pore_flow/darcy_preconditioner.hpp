#pragma once

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/time/ode_system.hpp"
#include "modules/pore_flow/darcy_system.hpp"
#include "modules/pore_flow/flow_multigrid.hpp"

namespace perifrac {

/// What is near to the inverse of I - gamma J of Darcy flow, for GMRES: by one cycle of multigrid
/// for the symmetric V S + gamma H in the potential. The bonds' own part of the flow stands in for
/// H, with a third of the entries and the same spectrum up to a factor, and what points store by
/// themselves for S. The solution is S times the pressure: put together from fluxes it would
/// magnify what the cycle leaves by gamma H / S. The volume that this loses is put back as the
/// pressure of water that is poured everywhere in proportion to S, which loses as little.
template <int D>
class DarcyPreconditioner final : public NewtonMatrix {
 public:
  /// The system must outlive the matrix.
  explicit DarcyPreconditioner(DarcySystem<D>& system);

  bool exact() const override { return false; }
  void set_up(double t, std::span<const double> y, double gamma) override;
  void solve(std::span<const double> r, std::span<double> solution) override;

 private:
  void assemble();
  void take_held_flow(const Eigen::SparseMatrix<double>& flow);

  DarcySystem<D>& system_;
  std::uint64_t pattern_version_ = 0;  ///< of what is assembled; 0: nothing yet
  std::unique_ptr<FlowMultigrid> multigrid_;
  Eigen::SparseMatrix<double> face_flow_;  ///< a column a face: what it lets in
  Eigen::SparseMatrix<double> held_flow_;  ///< a column a held point: what leaves it
  Eigen::VectorXd let_in_;                 ///< sum of both
  double gamma_ = 0.0;
  Eigen::VectorXd storage_;  ///< V S; 0 of held points
  Eigen::VectorXd kept_;     ///< its product with a pressure: volume that this needs of r
  Eigen::VectorXd poured_;   ///< pressure
  double poured_volume_ = 0.0;
  Eigen::VectorXd right_side_, pressure_, face_inflow_, held_outflow_;
};

}  // namespace perifrac
