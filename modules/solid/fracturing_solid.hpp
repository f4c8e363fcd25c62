#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "modules/solid/equilibrium/crack_growth.hpp"
#include "modules/solid/equilibrium/cracked_equilibrium.hpp"
#include "modules/solid/equilibrium/cracked_load.hpp"
#include "modules/solid/equilibrium/cracked_work.hpp"
#include "modules/solid/equilibrium/stiffness_solver.hpp"

namespace perifrac {

/// The quasi-static solid with cracks that grow (in 2D in plane strain): in equilibrium at the end
/// of every window (cracked_equilibrium.hpp), where its cracks go on and new ones begin
/// (crack_growth.hpp).
///
/// Ports: those of QuasiStaticSolid; and on the facets of the cracks (`crack`): in `crack_pressure`
/// [Pa], `crack_viscosity` [Pa s] and Carter's `crack_leak_off` [m/s^0.5], of the fluid at the
/// facet, 0 where it is dry, and its `crack_fluid_weight` [Pa]; out `crack_opening` [m], and the
/// property `free_crack_opening` [m], what it would be if closed faces did not press on each other
/// (negative: they pass through one another), with its slope against crack_pressure, a matrix.
/// `damage` of the points (paper Eq 16), `crack_length` [m], of it `open_crack_length` where faces
/// are apart, in 3D `crack_area` and `open_crack_area` [m^2], and `fracture_energy` [J], what new
/// faces took, in 2D per metre. `radiated_energy` [J/m] is what growth in 2D sets free beyond that:
/// where no fluid is in the cracks, unstable growth, by J; a body with inertia would move by it.
/// Beside fluid what viscosity takes ahead of the last whole facet, where tips move within them:
/// then the property `crack_part` is how much of a facet is crack. Where a crack begins by itself
/// or ends, at a face or another crack, that is what the balance of energy says. With friction
/// between faces `friction_dissipation` [J/m], `crack_slip` [m] of the facets, how far the face on
/// the left of a crack's path has gone along it beyond the other, and `crack_slip_area` [m^2], that
/// of all facets, counted positive, times their length.
template <int D>
class FracturingSolid final : public PhysicsModule {
 public:
  /// `fracture_energy` infinite: no crack grows. `tensile_strength`, in 2D: cracks begin at it.
  /// `friction`: between faces, in 2D; null: none.
  FracturingSolid(std::shared_ptr<const Body<D>> body, std::shared_ptr<Family<D>> family,
                  std::shared_ptr<BreakableElasticity<D>> elastic, const SolidBoundary<D>& boundary,
                  std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
                  FractureEnergy<D> fracture_energy,
                  const std::optional<TensileStrength<D>>& tensile_strength = {},
                  std::unique_ptr<CrackFriction> friction = nullptr,
                  const SolverChoice& choice = {});

  /// As QuasiStaticSolid's.
  std::string free_motion();

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  /// As QuasiStaticSolid's.
  void set_pore_stress_at_rest(std::vector<double> stress) {
    load_.set_pore_stress_at_rest(std::move(stress));
  }

  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  void prepare(const TimeWindow& window) override {
    cracked_->renew_slope();
    growth_.begin(window);
  }
  double expected_end(const TimeWindow& window) const override {
    return growth_.expected_end(window);
  }
  double advance(const TimeWindow& window) override;
  bool wants_another_pass() const override { return !tips_are_found_; }
  double conclude(const TimeWindow& window) override;
  void visit_state(StateVisitor& visitor) override;
  std::string path() const override { return cracked_->path(); }
  void on_restored(double t) override;

 private:
  void make_ports();
  void make_field_ports();
  void make_crack_ports();
  void make_energy_ports();
  std::string place_of(Eigen::Index free) const;
  BodyError loose_piece(const std::string& piece) const;

  std::shared_ptr<const Body<D>> body_;
  std::vector<CrackFacet<D>> seeds_;
  std::vector<std::pair<std::string, Index>> plates_;  ///< face, and an unknown that it moves
  std::vector<double> dilatation_slope_;

  BondState<D>& bonds_;
  std::unique_ptr<CrackedBody<D>> cracked_;
  CrackedLoad<D> load_;
  FluidInCracks fluid_;
  std::unique_ptr<CrackFriction> friction_;  ///< null: there is none
  CrackedEquilibrium<D> equilibrium_;
  CrackedWork<D> work_;
  CrackGrowth<D> growth_;
  bool tips_are_found_ = true;
  PortTable ports_;
};

}  // namespace perifrac
