#pragma once

#include <memory>
#include <vector>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "modules/fluid/fluid_dynamics.hpp"

namespace perifrac {

/// A free fluid on moving points, by whichever method, in as many steps as a window needs.
///
/// Ports, on its own moving points: out `fluid_pressure` [Pa], `fluid_velocity` [m/s],
/// `fluid_density` [kg/m^3], `fluid_mass` [kg]; on its own: `free_fluid_mass` [kg],
/// `<name>_displacement` [m] of each piston, and counts of work; with inlets `injected_fluid_mass`
/// [kg], where points may be removed `removed_fluid_mass` [kg, negative] and `points_left`.
/// On the points of a body, if there is one: in `displacement` [m]; out `interface_impulse` [N s],
/// what the fluid gave each point over the window; where fluid may enter broken rock, in `damage`.
/// If it has pores: in `pore_pressure` [Pa] with rate and slope, `pore_mobility` [m^2/(Pa s)]; out
/// `exchanged_mass` [kg], likewise.
/// Where cracks open into it, on their mouths: in `mouth_taken` [kg]; out `mouth_pressure` [Pa],
/// `mouth_stiffness`, `mouth_volume_stiffness` [Pa/kg], `mouth_relaxation` [s], `mouth_given` [kg];
/// for the ledger `mass_given_to_cracks` [kg].
template <int D>
class FreeFluid final : public PhysicsModule {
 public:
  /// `body` is null where the fluid is alone; `exchanges`: the body has pores.
  FreeFluid(std::shared_ptr<const Body<D>> body, bool exchanges,
            std::unique_ptr<FluidDynamics<D>> dynamics);

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  void make_ports(bool exchanges);
  void make_point_ports();
  void make_total_ports();
  void make_energy_ports();
  void make_body_ports();
  void make_pore_ports();
  void make_mouth_ports();
  void make_piston_ports();
  const PointSet& moving_points();

  std::shared_ptr<const Body<D>> body_;
  std::unique_ptr<FluidDynamics<D>> dynamics_;
  PortTable ports_;
  double time_ = 0.0;           ///< [s]
  std::int64_t steps_ = 0;      ///< in this process
  std::uint64_t restored_ = 0;  ///< how often

  PointSet point_set_;
  // Inputs and their companions; empty until they are connected.
  std::vector<double> displacement_, displacement_rate_;
  std::vector<double> pore_pressure_, pore_pressure_rate_, pore_pressure_slope_;
  std::vector<double> pore_mobility_;
  std::vector<double> damage_, damage_rate_;
};

}  // namespace perifrac
