#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/module/physics_module.hpp"
#include "core/profile/profile.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "coupling/processor_time.hpp"

namespace perifrac {

/// A module in its place in the order of advancing, and the work it has done in this process.
struct ModuleSlot {
  std::string name;
  std::unique_ptr<PhysicsModule> module;
  std::int64_t advances = 0;  ///< calls of advance(), those that were taken back included
  double seconds = 0.0;       ///< wall time in the module [s]
  CholeskyWork factors{};     ///< what sparse factors did in the module
  double cpu_seconds = 0.0;   ///< of all threads meanwhile [s]
};

/// Counts the time of its own life, and what factors do meanwhile, as the module's.
class ModuleTime {
 public:
  explicit ModuleTime(ModuleSlot& slot) : profiled_(slot.name), slot_(slot) {}
  ModuleTime(const ModuleTime&) = delete;
  ModuleTime& operator=(const ModuleTime&) = delete;
  ~ModuleTime() {
    slot_.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
    slot_.cpu_seconds += processor_time() - cpu_start_;
    const CholeskyWork work = SparseCholesky::work();
    slot_.factors.factorisations += work.factorisations - work_start_.factorisations;
    slot_.factors.solves += work.solves - work_start_.solves;
  }

 private:
  using Clock = std::chrono::steady_clock;

  ProfilePart profiled_;
  ModuleSlot& slot_;
  Clock::time_point start_ = Clock::now();
  double cpu_start_ = processor_time();
  CholeskyWork work_start_ = SparseCholesky::work();
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
