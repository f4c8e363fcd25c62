#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
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
  double seconds = 0.0;       ///< wall time in the module [s]
  double cpu_seconds = 0.0;   ///< of all threads meanwhile [s]
};

/// Counts the time of its own life as the module's.
class ModuleTime {
 public:
  explicit ModuleTime(ModuleSlot& slot) : slot_(slot) {}
  ModuleTime(const ModuleTime&) = delete;
  ModuleTime& operator=(const ModuleTime&) = delete;
  ~ModuleTime() {
    slot_.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
    slot_.cpu_seconds += cpu_clock() - cpu_start_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double cpu_clock() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  ModuleSlot& slot_;
  Clock::time_point start_ = Clock::now();
  double cpu_start_ = cpu_clock();
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
