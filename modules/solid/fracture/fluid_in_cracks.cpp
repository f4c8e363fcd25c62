#include "modules/solid/fracture/fluid_in_cracks.hpp"

namespace perifrac {

void FluidInCracks::add_ports(PortTable& ports) {
  add_port(ports, {"crack_pressure", "Pa"}, pressure_);
  add_port(ports, {.name = "crack_viscosity", .unit = "Pa s", .role = PortRole::property},
           viscosity_);
  add_port(ports, {.name = "crack_leak_off", .unit = "m/s^0.5", .role = PortRole::property},
           leak_off_);
  add_port(ports, {.name = "crack_fluid_weight", .unit = "Pa", .role = PortRole::property},
           weight_);
}

void FluidInCracks::add_port(PortTable& ports, Port port, Input& input) {
  ports.in(
      std::move(port), [&input] { input.is_connected = true; },
      [this, &input] {
        if (input.is_connected) input.value.resize(facets_.count);
        return PortView{&facets_, input.value};
      });
}

std::span<const double> FluidInCracks::pressure() {
  pressure_.value.resize(facets_.count);
  return pressure_.value;
}

}  // namespace perifrac
