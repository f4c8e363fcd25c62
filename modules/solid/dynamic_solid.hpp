#pragma once

#include <memory>
#include <vector>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "core/time/velocity_verlet.hpp"
#include "modules/solid/boundary/interface_force.hpp"
#include "modules/solid/fracture/critical_stretch.hpp"
#include "modules/solid/motion/elastic_dynamics.hpp"

namespace perifrac {

/// A linear elastic solid with inertia, by velocity Verlet in as many equal steps as a window
/// needs; no matrix. At rest and undeformed at the start. Small strain, and small rotations too
/// unless the operator is corotational. In a window of no length nothing with a mass moves: loads
/// act from then on.
///
/// Ports: in `pore_stress` [Pa], with rate and slope, `interface_impulse` [N s] on the points; out
/// `displacement` [m], `velocity` [m/s], `dilatation`, `effective_stress` [Pa] (as
/// QuasiStaticSolid), `elastic_energy`, `kinetic_energy`, `external_work`, `damped_energy` [J] (per
/// metre in 2D), `integrator_steps`, and for each rigid plate `<face>_plate_displacement` [m],
/// along its axis. Where bonds may break, `damage` of the points (paper Eq 16) and
/// `fracture_energy` [J], what breaking took from the elastic energy.
template <int D>
class DynamicSolid : public PhysicsModule {
 public:
  /// density [kg/m^3]; damping [1/s] of all velocities; a step is at most safety (0 to 1) times the
  /// stable limit. The operator's mirror condition is the boundary's. `breaking` breaks its bonds;
  /// none: no bond breaks.
  DynamicSolid(std::shared_ptr<const Body<D>> body, std::shared_ptr<ElasticOperator<D>> elastic,
               const SolidBoundary<D>& boundary, double density, double damping, double safety,
               std::unique_ptr<CriticalStretch<D>> breaking = nullptr);

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  std::string path() const override { return system_->path(); }
  void on_restored(double t) override;

 protected:
  /// [J], per metre in 2D.
  virtual double external_work() const { return system_->external_work(); }
  virtual double damped_energy() const { return motion_.damped_energy; }

  std::shared_ptr<const Body<D>> body_;
  PortTable ports_;
  std::unique_ptr<CriticalStretch<D>> breaking_;
  std::unique_ptr<ElasticDynamics<D>> system_;
  std::unique_ptr<VelocityVerlet> verlet_;
  double time_ = 0.0;  ///< [s]
  Motion motion_;      ///< no acceleration until the first window finds it

  std::vector<double> pore_stress_;  ///< input and its companions; empty until it is connected
  std::vector<double> pore_stress_rate_;
  std::vector<double> pore_stress_slope_;
  InterfaceForce interface_;

 private:
  void make_ports(const SolidBoundary<D>& boundary);
  void connect_interface();
};

}  // namespace perifrac
