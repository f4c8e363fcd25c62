#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/body/fluid_weight.hpp"
#include "core/module/physics_module.hpp"
#include "core/module/port_table.hpp"
#include "modules/crack_fluid/crack_books.hpp"
#include "modules/crack_fluid/crack_extent.hpp"
#include "modules/crack_fluid/crack_flow.hpp"
#include "modules/crack_fluid/crack_inlets.hpp"
#include "modules/crack_fluid/crack_mouths.hpp"
#include "modules/crack_fluid/crack_outlets.hpp"
#include "modules/crack_fluid/face_work.hpp"
#include "modules/crack_fluid/facet_fluid.hpp"
#include "modules/crack_fluid/leak_off.hpp"
#include "modules/crack_fluid/opening_input.hpp"
#include "modules/crack_fluid/pore_leak_off.hpp"

namespace perifrac {

/// A part of the crack that holds fluid at the start.
template <int D>
struct CrackFilling {
  Region<D> box;
  double pressure;  ///< [Pa]
};

/// Fluid in the cracks of a body, implicit: one step a window, together with what the facets'
/// opening answers to it. How fluid moves within cracks, `flow` says. Facets that are added are
/// dry.
///
/// Ports, on the facets ("crack"): in `free_crack_opening` [m], takes rate and a slope of count *
/// count values against `crack_pressure`, and the property `crack_part`, how much of a facet is
/// crack, 1 unless somebody says; out `crack_pressure` [Pa], `crack_fluid_mass` [kg/m],
/// `crack_wetted_fraction`, where rates are known `crack_flow_rate` [m^2/s] from a facet's first
/// end to its second, the properties `crack_viscosity` [Pa s] and, by Carter's law,
/// `crack_leak_off` [m/s^0.5], 0 where less than half a facet is wet, and under gravity
/// `crack_fluid_weight` [Pa], the pressure of fluid at rest, 0 at the body's top. On its own:
/// `wetted_length` and `fluid_lag` [m], `crack_volume` [m^2], `mean_crack_pressure` [Pa]
/// (crack_extent.hpp), `inlet_<name>_pressure` [Pa], `inlet_<name>_opening` [m], of clusters of a
/// well also `inlet_<name>_rate` [m^2/s], and `well_<name>_pressure` [Pa], with leak-off
/// `leak_off_volume` [m^2] at zero pressure, since the start, and `leak_off_rate` [m^2/s], the mean
/// of the last window; for the ledger `crack_fluid_stored_mass`, `injected_crack_fluid_mass`, with
/// leak-off `leaked_crack_fluid_mass` (negative, of Carter's) [kg/m], `crack_fluid_energy`,
/// `crack_fluid_work`, `crack_flow_dissipation` [J/m]; counts of work. With leak-off into pores, on
/// the body's points: in `pore_pressure` [Pa], takes rate and a slope against `exchanged_mass`,
/// `pore_mobility` [m^2/(Pa s)]; out `exchanged_mass` [kg/m]. With inlets from free fluid, on their
/// mouths: in `mouth_pressure` [Pa], `mouth_stiffness`, `mouth_volume_stiffness` [Pa m/kg],
/// `mouth_relaxation` [s], `mouth_given` [kg/m]; out `mouth_taken` [kg/m]; for the ledger
/// `mass_taken_by_cracks` (negative) [kg/m]. In 3D without the /m of totals, and m^3 for m^2;
/// `wetted_area` and `dry_area` [m^2] in place of the two lengths, and no `crack_flow_rate`.
template <int D>
class CrackFluid final : public PhysicsModule {
 public:
  /// `leak_off` and `outlets` may be null; without these a crack that grows to a face stays closed.
  /// `gravity`: an acceleration [m/s^2].
  CrackFluid(std::shared_ptr<const Body<D>> body, const CrackLiquid& liquid,
             std::unique_ptr<CrackFlow> flow, CrackInlets inlets,
             std::vector<CrackFilling<D>> fillings, std::unique_ptr<LeakOff> leak_off,
             std::unique_ptr<CrackOutlets<D>> outlets = nullptr, const Vector<D>& gravity = {});

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override;
  void initialize(double t) override;
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  void make_ports();
  void make_facet_ports();
  void make_extent_ports();
  void make_inlet_ports();
  void make_mass_ports();
  void make_exchange_ports();
  void make_energy_ports();
  Eigen::VectorXd heights() const;
  void match_facets();
  void fill_at_start(const TimeWindow& window);
  bool step(const TimeWindow& time, const TimeWindow& window);
  void book(const Eigen::VectorXd& v);
  void rest(const TimeWindow& window);
  std::vector<double> flow_rate();
  CrackExtent extent() const {
    return crack_extent(flow_->graph(), liquid_, facets_.unknown, facets_.aperture, part_);
  }
  double stored_mass() const;
  /// What fluid gains by its height at a facet [J/kg].
  double height_of(std::size_t f) const {
    return flow_->height(static_cast<Index>(f)) / liquid_.density;
  }
  double leak_off_volume() const { return -books_.leaked.value() / liquid_.density; }  ///< [m^2]

  std::shared_ptr<const Body<D>> body_;
  CrackLiquid liquid_;
  FluidWeight<D> weight_;
  std::unique_ptr<CrackFlow> flow_;
  CrackInlets inlets_;
  CrackMouths mouths_;
  std::vector<CrackFilling<D>> fillings_;
  std::unique_ptr<LeakOff> leak_off_;
  std::unique_ptr<CrackOutlets<D>> outlets_;
  PoreLeakOff<D>* pores_;  ///< which is the leak-off, or null
  PortTable ports_;
  struct {
    std::int64_t steps = 0, iterations = 0;
  } work_;  ///< in this process

  std::uint64_t version_ = 0;  ///< of the facets that the graph is made of
  FacetFluid facets_;
  FaceWork face_work_;
  std::int64_t has_begun_ = 0;  ///< state: what holds fluid at the start has been filled
  CrackBooks books_;
  double leak_off_rate_ = 0.0;  ///< mean of the last window of some length [m^2/s]
  OpeningInput opening_;
  std::vector<double> part_;  ///< of every facet that is crack; a tip is within the others
};

}  // namespace perifrac
