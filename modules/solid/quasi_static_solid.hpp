#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "modules/solid/boundary/interface_force.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/equilibrium/stiffness_solver.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// A solid in equilibrium at the end of every window, solved for by StiffnessSolver; where its
/// stress is not linear in strain, by Newton's method. Loads and prescribed displacements are those
/// of the window's end. Small strain.
///
/// Ports: in `pore_stress` [Pa], `interface_impulse` [N s] on the points; out `displacement` [m],
/// `dilatation` with its slope d(dilatation)/d(pore_stress), `effective_stress` [Pa] (D * D
/// components, row by row, tension positive; total stress is this less the pore stress),
/// `elastic_energy`, `external_work` [J] (per metre in 2D), and for each rigid plate
/// `<face>_plate_displacement` [m], along its axis.
template <int D>
class QuasiStaticSolid final : public PhysicsModule {
 public:
  /// `elastic` has the boundary's mirror condition. Its initial stress does not move the body, as
  /// what lies behind the faces bears it; energy and work are counted from there.
  /// Throws BodyError where `choice` asks for what the body cannot have.
  QuasiStaticSolid(std::shared_ptr<const Body<D>> body, std::shared_ptr<ElasticOperator<D>> elastic,
                   const SolidBoundary<D>& boundary, const SolverChoice& choice = {});

  /// A motion of the whole body that nothing resists, in words; empty where there is none. Such a
  /// body has no equilibrium: do not initialize it.
  const std::string& free_motion() const { return free_motion_; }

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  /// Of every point, what of the pore stress does not load the rock: that of a body at rest under a
  /// total stress (stress_at_rest.hpp). Empty: nothing.
  void set_pore_stress_at_rest(std::vector<double> stress) {
    pore_stress_at_rest_ = std::move(stress);
  }

  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  std::string path() const override { return solver_->path(); }
  void on_restored(double t) override;

 private:
  void make_ports();
  void find_effective_stress(std::vector<double>& stress) const;
  std::string find_free_motion(const Eigen::SparseMatrix<double>& free_unknowns) const;
  Eigen::VectorXd pore_force() const;
  double work_at_rest() const;
  void prescribe(const TimeWindow& window);
  void derive_from_unknowns();

  std::shared_ptr<const Body<D>> body_;
  std::shared_ptr<ElasticOperator<D>> elastic_;
  NonlinearResponse* memory_;  ///< of the rock; nullptr: it has none
  PortTable ports_;
  std::vector<std::pair<std::string, Index>> plates_;  ///< face, and an unknown that it moves
  std::string free_motion_;
  std::unique_ptr<StiffnessSolver<D>> solver_;
  std::vector<Index> held_;        ///< unknowns that are prescribed
  ScheduledVector prescribed_{0};  ///< displacements that are prescribed, 0 elsewhere [m]
  ScheduledVector load_{0};        ///< on every unknown, reactions left out [N]

  std::vector<double> unknowns_;  ///< D blocks of displacement, then face values [m]
  std::vector<double> force_;     ///< external force on every unknown, reactions included [N]
  double external_work_ = 0.0;
  std::vector<double> inner_force_;  ///< what the rock answers to the unknowns [N]

  std::vector<double> pore_stress_;          ///< input; empty until it is connected
  std::vector<double> pore_stress_at_rest_;  ///< empty: none
  InterfaceForce interface_;
  std::vector<double> dilatation_;
  std::vector<double> slope_;
  double elastic_energy_ = 0.0;
};

}  // namespace perifrac
