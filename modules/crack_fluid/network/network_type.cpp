#include "modules/crack_fluid/network/network_type.hpp"

#include "modules/crack_fluid/crack_fluid_keys.hpp"
#include "modules/crack_fluid/network/lubrication.hpp"

namespace perifrac {

namespace {

KeyTable network_keys() {
  KeyTable keys = crack_fluid_keys();
  keys.insert(keys.begin() + 1, {.path = "viscosity",
                                 .unit = "Pa s",
                                 .range = "(0, inf)",
                                 .required = true,
                                 .meaning = "Dynamic viscosity."});
  return keys;
}

template <int D>
std::unique_ptr<PhysicsModule> make_network(const Section& section,
                                            std::shared_ptr<const Body<D>> body) {
  const CrackLiquid liquid = read_crack_liquid(section, section.number("viscosity"));
  return make_crack_fluid<D>(section, std::move(body), liquid,
                             std::make_unique<Lubrication>(liquid));
}

}  // namespace

ModuleType crack_network_type() {
  return {.section = "crack_fluid",
          .name = "network",
          .meaning = "Fluid in cracks, on the facets that cut broken bonds. Implicit.",
          .keys = network_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_network(section, body); }, any);
          }};
}

}  // namespace perifrac
