#pragma once

#include <algorithm>
#include <string>

#include "core/module/physics_module.hpp"

namespace perifrac::test {

/// The port of that name; an in-port is connected, as where a module writes it.
inline PortView port_named(PhysicsModule& module, const std::string& name) {
  const auto ports = module.ports();
  const auto found = std::ranges::find(ports, name, &Port::name);
  const auto id = static_cast<PortId>(found - ports.begin());
  if (found->direction == PortDirection::in) module.connect(id);
  return module.port(id);
}

}  // namespace perifrac::test
