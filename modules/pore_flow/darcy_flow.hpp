#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "core/time/integrator.hpp"
#include "modules/pore_flow/darcy_system.hpp"

namespace perifrac {

/// Makes the integrator of a Darcy system; it may keep a reference to it.
template <int D>
using DarcyIntegratorMaker = std::function<std::unique_ptr<Integrator>(DarcySystem<D>&)>;

/// The pressure that a run begins with.
template <int D>
struct InitialPressure {
  double value = 0.0;           ///< at the origin [Pa]
  Vector<D> gradient{};         ///< [Pa/m]
  bool is_hydrostatic = false;  ///< grows downwards so that fluid rests, from `value` at the
                                ///< highest corner of the body
};

/// Pore flow after Darcy, by whichever integrator it is given. No fluid crosses bonds of the body
/// that are broken (Body::bond_state).
///
/// Ports: in `dilatation`, `exchanged_mass` [kg] that others hand over to each point; out
/// `pore_pressure` [Pa] with its slope d(pore_pressure)/d(exchanged_mass), `pore_stress` (alpha p)
/// with its undrained slope d(pore_stress)/d(dilatation) [Pa] where storage is local,
/// `fluid_content`, `darcy_velocity`
/// [m/s], the property `pore_mobility` [m^2/(Pa s)], and for the ledger `pore_fluid_mass`,
/// `pore_fluid_gained` [kg], `pore_fluid_energy`, `pore_fluid_work`, `darcy_dissipation` [J] (per
/// metre in 2D); `artificial_fluid_mass` [kg] where pressures are smoothed.
template <int D>
class DarcyFlow final : public PhysicsModule {
 public:
  DarcyFlow(std::shared_ptr<const Body<D>> body, DarcySystem<D> system,
            InitialPressure<D> initial_pressure, const DarcyIntegratorMaker<D>& make_integrator);

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  void prepare(const TimeWindow& window) override;
  double advance(const TimeWindow& window) override;
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  std::string path() const override;
  void on_restored(double t) override;

 private:
  void make_ports();
  void make_in_ports();
  void make_field_ports();
  void make_ledger_ports();
  void make_work_ports();
  double initial_pressure(Index i) const;
  void follow_bonds();
  void integrate(const TimeWindow& window);
  void flow(const TimeWindow& window);
  void find_pressure(double t);
  void note_jump(double t);
  void update_content();
  std::span<double> content();
  void update_pore_stress();
  std::vector<double> mobility() const;
  void find_pressure_slope();

  std::shared_ptr<const Body<D>> body_;
  std::unique_ptr<DarcySystem<D>> system_;
  std::unique_ptr<Integrator> integrator_;
  InitialPressure<D> initial_pressure_;

  std::vector<double> unknowns_;  ///< of the system
  double start_ = 0.0;            ///< [s]
  double time_ = 0.0;             ///< [s]
  double last_jump_ = 0.0;        ///< of what drives the flow [s]
  bool restart_integrator_ = true;

  std::vector<double> dilatation_;  ///< input and its companions; empty until it is connected
  std::vector<double> dilatation_rate_;
  std::vector<double> dilatation_slope_;
  std::vector<double> content_;  ///< empty where it is the unknowns' own
  std::vector<double> pressure_;
  std::vector<double> pore_stress_;
  std::vector<double> pore_stress_slope_;
  std::vector<double> pressure_slope_;  ///< d(pore_pressure)/d(exchanged_mass) [Pa/kg]
  PortTable ports_;
};

}  // namespace perifrac
