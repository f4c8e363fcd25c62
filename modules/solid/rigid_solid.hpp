#pragma once

#include <limits>

#include "core/module/physics_module.hpp"

namespace perifrac {

/// A solid that does not deform: no unknowns, no ports, no work. Pore flow beside it sees no
/// dilatation.
class RigidSolid final : public PhysicsModule {
 public:
  std::span<const Port> ports() const override { return {}; }
  PortView port(PortId) override { return {}; }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override { return window.end; }
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}
};

}  // namespace perifrac
