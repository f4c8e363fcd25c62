#pragma once

#include "core/module/module_type.hpp"
#include "modules/fluid/method/fluid_method.hpp"

namespace perifrac {

/// Makes the fluid of a section by a method; throws InputError.
std::unique_ptr<PhysicsModule> make_fluid(const FluidMethodType& method, const Section& section,
                                          const AnyBody& body);

/// The keys of the section: one set, and what a method does not say is one for all of them.
KeyTable fluid_keys(const FluidMethodType& method);

/// The module of a method, by its word.
template <FluidMethodType (*find_method)()>
ModuleType fluid_type() {
  const FluidMethodType method = find_method();
  return {.section = "fluid",
          .name = method.name,
          .meaning = method.meaning,
          .keys = fluid_keys(method),
          .make = [](const Section& section,
                     const AnyBody& body) { return make_fluid(find_method(), section, body); },
          .needs_body = false};
}

/// The keys of the section `interface`: what free fluid and a body do to each other.
const KeyTable& interface_keys();

}  // namespace perifrac
