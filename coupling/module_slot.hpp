#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/module/physics_module.hpp"

namespace perifrac {

/// A module in its place in the order of advancing, and the work it has done in this process.
struct ModuleSlot {
  std::string name;
  std::unique_ptr<PhysicsModule> module;
  std::int64_t advances = 0;  ///< calls of advance(), those that were taken back included
  double seconds = 0.0;       ///< wall time in them [s]
};

/// Shows the state of each module, its fields named `<module>/<field>`.
inline void visit_modules(std::span<ModuleSlot> modules, StateVisitor& visitor) {
  for (ModuleSlot& slot : modules) {
    visitor.enter(slot.name);
    slot.module->visit_state(visitor);
    visitor.leave();
  }
}

}  // namespace perifrac
