#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "modules/crack_fluid/crack_fluid.hpp"
#include "modules/crack_fluid/network/lubrication.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac::test {

/// Facets of these tests [m]: their length, and how far they are open.
inline constexpr double dx = 1e-3, w = 5e-5;

/// Corners of a straight line of equal facets.
inline std::vector<Vector<2>> straight_line(const Vector<2>& from, double angle, double facet,
                                            int facets) {
  std::vector<Vector<2>> corners;
  for (int k = 0; k <= facets; ++k) {
    corners.push_back(
        {from[0] + k * facet * std::cos(angle), from[1] + k * facet * std::sin(angle)});
  }
  return corners;
}

inline CrackInlet rate_inlet(const Vector<2>& at, double rate, Schedule schedule = {}) {
  return {"pump", {at[0], at[1]}, false, rate, std::move(schedule)};
}
inline CrackInlet pressure_inlet(const std::string& name, const Vector<2>& at, double pressure) {
  return {name, {at[0], at[1]}, true, pressure, {}};
}

inline CrackInlet cluster(const std::string& name, const Vector<2>& at) {
  CrackInlet inlet{name, {at[0], at[1]}, false, 0.0, {}};
  inlet.from_well = true;
  return inlet;
}

/// Fluid in a crack, a network where nothing else is given, whose facets are given and whose
/// opening is value + slope p.
class CrackRun {
 public:
  CrackRun(const CrackLiquid& liquid, std::vector<CrackInlet> inlets,
           std::vector<CrackFilling<2>> fillings = {}, std::unique_ptr<LeakOff> leak_off = nullptr,
           std::unique_ptr<CrackFlow> flow = nullptr, std::vector<CrackWell> wells = {})
      : body_(box_body<2>({3, 3}, 1.0)),
        bonds_(body_->claim_bond_state()),
        module_(std::make_unique<CrackFluid<2>>(
            body_, liquid, flow ? std::move(flow) : std::make_unique<Lubrication>(liquid),
            CrackInlets(std::move(inlets), liquid, std::move(wells)), std::move(fillings),
            std::move(leak_off))) {
    module_->initialize(0.0);
  }

  void add_line(const std::vector<Vector<2>>& corners) {
    for (std::size_t k = 1; k < corners.size(); ++k) {
      bonds_.add_facet({corners[k - 1], corners[k]}, {});
    }
  }

  CrackFluid<2>& module() { return *module_; }
  PortView port(const std::string& name) { return test::port_named(*module_, name); }
  std::vector<double> values(const std::string& name) {
    const auto value = port(name).value;
    return {value.begin(), value.end()};
  }
  double scalar(const std::string& name) { return port(name).value[0]; }

  /// The same at all facets; every facet answers to its own pressure.
  void open(double value, double compliance = 0.0) {
    const PortView view = port("free_crack_opening");
    const std::size_t count = view.value.size();
    std::ranges::fill(view.value, value);
    for (std::size_t f = 0; f < count; ++f) view.slope[f * count + f] = compliance;
  }

  void advance(double length) {
    module_->advance({time_, time_ + length});
    time_ += length;
  }
  void advance(double length, int windows) {
    const double begin = time_;
    for (int k = 1; k <= windows; ++k) {
      const double end = begin + length * k / windows;
      module_->advance({time_, end});
      time_ = end;
    }
  }
  double time() const { return time_; }

  /// Fluid that is there beyond what came in, over what is there.
  double mass_error() {
    double gained = scalar("injected_crack_fluid_mass");
    for (const Port& port : module_->ports()) {
      if (port.name == "leaked_crack_fluid_mass") gained += scalar(port.name);
    }
    const double stored = scalar("crack_fluid_stored_mass");
    return std::abs(stored - gained) / std::max(std::abs(stored), std::abs(gained));
  }

 private:
  std::shared_ptr<const Body<2>> body_;
  BondState<2>& bonds_;
  std::unique_ptr<CrackFluid<2>> module_;
  double time_ = 0.0;
};

constexpr CrackLiquid water{.density = 1000.0,
                            .viscosity = 1e-3,
                            .bulk_modulus = 2.2e9,
                            .vapour_pressure = 0.0,
                            .residual_aperture = 1e-9};

}  // namespace perifrac::test
