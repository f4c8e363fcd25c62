#pragma once

#include <memory>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/module/physics_module.hpp"
#include "modules/crack_fluid/crack_flow.hpp"

namespace perifrac {

/// What all kinds of crack fluid read of a scene. Those that have a viscosity require the key
/// `viscosity` besides; others may take it, so that one word swaps them.
KeyTable crack_fluid_keys();

/// The fluid, with this viscosity [Pa s]. Throws InputError.
CrackLiquid read_crack_liquid(const Section& section, double viscosity);

/// The module that the section describes, whose fluid moves by `flow`. Throws InputError.
template <int D>
std::unique_ptr<PhysicsModule> make_crack_fluid(const Section& section,
                                                std::shared_ptr<const Body<D>> body,
                                                const CrackLiquid& liquid,
                                                std::unique_ptr<CrackFlow> flow);

}  // namespace perifrac
