#pragma once

#include <span>
#include <vector>

#include "core/module/port_table.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// What other modules write of the fluid in a body's cracks, on their facets: pressure [Pa],
/// viscosity [Pa s] and Carter's coefficient of one side [m/s^0.5], 0 where a facet is dry; and by
/// gravity what pressure it has there at rest beyond that at the body's top [Pa].
class FluidInCracks {
 public:
  /// The facets, to which cracks that grow add.
  explicit FluidInCracks(const PointSet& facets) : facets_(facets) {}

  /// In-ports `crack_pressure`, `crack_viscosity`, `crack_leak_off`, `crack_fluid_weight`.
  void add_ports(PortTable& ports);

  /// Some module writes the pressure.
  bool is_there() const { return pressure_.is_connected; }
  /// Of every facet; a new one is dry. Zeros where there is no fluid.
  std::span<const double> pressure();
  /// Of the facets that were there when it was written; empty where nobody does.
  std::span<const double> viscosity() const { return viscosity_.value; }
  std::span<const double> leak_off() const { return leak_off_.value; }
  std::span<const double> weight() const { return weight_.value; }

  /// A link reads openings anew under the pressure where facets were added at the end of a window.
  void visit_state(StateVisitor& visitor) { visitor.visit("crack_pressure", pressure_.value); }

 private:
  struct Input {
    bool is_connected = false;
    std::vector<double> value;
  };

  void add_port(PortTable& ports, Port port, Input& input);

  const PointSet& facets_;
  Input pressure_, viscosity_, leak_off_, weight_;
};

}  // namespace perifrac
