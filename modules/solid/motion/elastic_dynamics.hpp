#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/body/body.hpp"
#include "core/state/state_visitor.hpp"
#include "core/time/scheduled_vector.hpp"
#include "core/time/second_order_system.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/material/elastic_operator.hpp"
#include "modules/solid/material/nonlinear_response.hpp"
#include "modules/solid/motion/body_fracture.hpp"
#include "modules/solid/motion/external_work.hpp"
#include "modules/solid/motion/lumped_mass.hpp"
#include "modules/solid/motion/massless_plates.hpp"
#include "modules/solid/motion/moving_pore_stress.hpp"

namespace perifrac {

/// Newton's law for an elastic body: m u'' = load - dE/du, for all that is free to move and has a
/// mass. What is prescribed moves as prescribed. A rigid plate on a mirrored face has no mass: its
/// place follows from its equilibrium at every time. One on a layer moves the layer's mass.
template <int D>
class ElasticDynamics final : public SecondOrderSystem {
 public:
  /// `density` is the rock's, fluid included [kg/m^3]; the operator's mirror condition is the
  /// boundary's.
  ElasticDynamics(const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
                  const SolidBoundary<D>& boundary, double density);

  std::string_view name() const override { return "displacement"; }
  std::string place(std::size_t unknown) const override;
  std::span<const double> mass() const override { return moved_.mass(); }
  void force(double t, std::span<const double> y, std::span<double> force) override;
  void stiffness_times(std::span<const double> v, std::span<double> product) override;
  std::uint64_t stiffness_version() const override { return version_; }
  double stiffness_growth() const override {
    return pore_stress_.growth() * (fracture_ != nullptr ? fracture_->stiffness_growth() : 1.0);
  }
  void begin_step(double step, std::span<double> velocity) override {
    if (fracture_ != nullptr) fracture_->begin_step(step, velocity);
  }
  void end_step(double step, std::span<double> velocity) override {
    if (fracture_ != nullptr) fracture_->end_step(step, velocity);
    if (memory_ != nullptr) memory_->follow(unknowns_, step);
  }
  bool changes() override;

  /// The body may break from now on, in the family of the operator. It must stay.
  void set_fracture(BodyFracture& fracture) { fracture_ = &fracture; }
  /// The rock, where it has a memory.
  NonlinearResponse* remembers() const { return memory_; }
  bool may_break() const { return fracture_ != nullptr; }
  /// Bonds were broken between steps.
  void note_broken_bonds() { plates_.forget(); }
  /// What moves an unknown, by its place in mass(); negative: nothing that has a mass.
  Index moved_by(Index unknown) const { return moved_.owner(unknown); }
  /// Force of the bonds at the present displacements and pore stress, on every unknown [N].
  void find_bond_force(std::span<double> force) { apply(unknowns_, pore_stress_.now(), force, {}); }

  /// Takes the input of the next window; spans must stay valid while it is integrated. The slope
  /// is part of the stiffness.
  void set_pore_stress(const PoreStressInput& input);

  /// That which acts on every point now, with what the rock's dilatation answers [Pa]; empty: none.
  /// Valid until the next call.
  std::span<const double> acting_pore_stress() { return pore_stress_.acting(dilatation_); }

  /// Takes a steady force on the points, D blocks [N]; it must stay valid until the next. Empty:
  /// none.
  void set_interface_force(std::span<const double> force);

  /// Undeformed, nothing done on it, and no interface force to come.
  void start();
  /// Interface forces may come; after start(), before anything moves.
  void expect_interface_force() { work_.start(acted_on(true)); }
  /// Displacements, the external force on each of them and the work it did.
  void visit_state(StateVisitor& visitor);
  /// The state was replaced: takes its stiffness of reference. Before derive().
  void note_reference();
  /// Then follows its broken bonds and finds dilatation anew.
  void derive();

  /// Displacements of what has a mass, gathered from the state.
  std::vector<double> position() const { return moved_.positions(unknowns_); }
  /// All displacements: D blocks of points, then face values [m].
  std::vector<double>& unknowns() { return unknowns_; }
  std::span<double> dilatation();  ///< of the points
  void effective_stress(std::span<double> stress) { elastic_->stress(unknowns_, stress); }
  double elastic_energy();                               ///< without pore stress [J]
  double external_work() const { return work_.sum(); }   ///< [J]
  std::string path() const { return elastic_->path(); }  ///< of the bond forces
  /// An unknown that each rigid plate moves, in the boundary's order.
  const std::vector<Index>& plate_unknowns() const { return plate_unknowns_; }
  /// Velocity of the points, D blocks [m/s], from that of what has a mass. What is prescribed is
  /// taken at its mean speed since `step` ago [s].
  void point_velocity(double t, double step, std::span<const double> velocity,
                      std::span<double> result);

 private:
  void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
             std::span<double> dilatation);
  void apply_small(std::span<const double> u, const PoreStress& pore, std::span<double> force,
                   std::span<double> dilatation);
  void take_initial_force(std::span<double> force) const;

  void place_plates(std::span<const double> load, std::span<const double> pore_stress,
                    std::vector<double>& unknowns);
  void find_loads(double t);
  std::vector<Index> acted_on(bool by_interface) const;

  /// Of every unknown, at the time of a force: what is prescribed, empty where nothing is, and the
  /// load; displacements tried.
  struct Now {
    Eigen::VectorXd prescribed{}, load;
    std::vector<double> trial;
  };

  const Body<D>& body_;
  std::shared_ptr<ElasticOperator<D>> elastic_;
  NonlinearResponse* memory_;  ///< of the rock; nullptr: it has none
  BodyFracture* fracture_ = nullptr;
  std::vector<double> initial_force_;  ///< of the initial stress [N]; empty without one
  ScheduledVector prescribed_;
  ScheduledVector loads_;
  LumpedMass moved_;
  MasslessPlates plates_;
  std::vector<Index> plate_unknowns_;
  std::uint64_t version_ = 0;

  std::vector<double> unknowns_;  ///< [m]
  ExternalWork work_;
  std::vector<double> dilatation_;
  std::span<const double> interface_force_;
  MovingPoreStress pore_stress_;

  /// inner_ is the force of the bonds at unknowns_, without anything else.
  bool inner_is_elastic_ = false;
  Now now_;
  std::vector<double> inner_;  // workspace
};

}  // namespace perifrac
