#pragma once

#include <string>
#include <vector>

#include "core/module/physics_module.hpp"
#include "coupling/manager.hpp"

namespace perifrac {

/// What somebody at the keyboard gives to in-ports that no module of the scene writes: a module
/// that advances before all others and whose out-ports hold what was put there. Links, rollback and
/// checkpoints treat it as any other.
class GivenInputs final : public PhysicsModule {
 public:
  static constexpr const char* module_name = "given";

  /// `names` as in `solid.interface_impulse`.
  explicit GivenInputs(std::vector<std::string> names) : names_(std::move(names)) {}

  /// Finds the in-ports, before anything is initialised. Throws InputError where there is none of
  /// that name, or a module writes it already.
  void find(const CouplingManager& manager);

  /// To be written between windows: one value a point and component. Of an intensive quantity its
  /// value at the window's end; of an extensive one what is handed over in each window.
  std::span<double> values(const std::string& name);
  int components(const std::string& name) const { return ports_[place_of(name)].components; }

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override;
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override { return window.end; }
  bool may_end_windows() const override { return false; }
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double) override {}

 private:
  struct Target {
    PhysicsModule* module;
    PortId port;
    std::vector<double> values{};
  };

  std::size_t place_of(const std::string& name) const;
  void add(const std::string& name, const CouplingManager& manager);

  std::vector<std::string> names_;
  std::vector<Port> ports_;
  std::vector<Target> targets_;
};

}  // namespace perifrac
