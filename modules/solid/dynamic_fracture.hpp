#pragma once

#include <memory>
#include <span>
#include <vector>

#include "modules/solid/dynamic_solid.hpp"
#include "modules/solid/fracture/crack_dynamics.hpp"
#include "modules/solid/fracture/crack_tips.hpp"
#include "modules/solid/fracture/fluid_in_cracks.hpp"

namespace perifrac {

/// The dynamic solid with cracks that grow (plane strain): by one facet of a spacing where
/// CrackTips says so, at the end of a step.
///
/// Ports: those of DynamicSolid, without breaking; and on the facets of the cracks (`crack`): in
/// `crack_pressure` [Pa], `crack_viscosity` [Pa s], `crack_leak_off` [m/s^0.5],
/// `crack_fluid_weight` [Pa]; out `crack_opening` [m], which it foretells over a step, with its
/// slope d(opening)/d(crack_pressure), a matrix. `damage` of the points (paper Eq 16),
/// `crack_length` [m] and `fracture_energy` [J/m], what growth took.
class DynamicFracture final : public DynamicSolid<2> {
 public:
  /// As DynamicSolid and CutBody. `fracture_energy` infinite: no crack grows.
  DynamicFracture(std::shared_ptr<const Body<2>> body, std::shared_ptr<Family<2>> family,
                  std::shared_ptr<BreakableElasticity<2>> elastic, const SolidBoundary<2>& boundary,
                  double density, double damping, double safety,
                  std::optional<InitialStress<2>> initial_stress, std::vector<CrackFacet<2>> seeds,
                  FractureEnergy<2> fracture_energy);

  void initialize(double t) override;
  void prepare(const TimeWindow& window) override;
  double advance(const TimeWindow& window) override;
  double conclude(const TimeWindow& window) override;
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  double external_work() const override;
  double damped_energy() const override;
  void add_ports();
  CrackState<2> state_of_cracks();
  Vector<2> inertia(Index i);
  void foretell(double t, double step);

  double damping_;
  std::vector<CrackFacet<2>> seeds_;
  BondState<2>& bonds_;
  CrackDynamics cracks_;
  CrackTips tips_;
  FluidInCracks fluid_;
};

}  // namespace perifrac
