#pragma once

#include <memory>
#include <vector>

#include "core/module/module_type.hpp"
#include "core/module/port_table.hpp"

namespace perifrac {

/// A rock that only thins and thickens under a constant overburden: no strain along the layers, so
/// that each point is a spring of its own, dilatation = (pore stress - overburden) / stiffness.
/// This is what reservoir engineering means by uniaxial compaction (Geertsma 1973). 2D.
///
/// Ports: in `pore_stress` [Pa]; out `dilatation` with its slope d(dilatation)/d(pore_stress)
/// [1/Pa], `compaction_energy`, `overburden_work` [J per metre].
class Compaction final : public PhysicsModule {
 public:
  /// `stiffness` is lambda + 2 mu of the drained rock [Pa]; `overburden` presses, positive [Pa].
  Compaction(std::shared_ptr<const Body<2>> body, double stiffness, double overburden);

  std::span<const Port> ports() const override { return ports_.list(); }
  PortView port(PortId id) override { return ports_.view(id); }
  void initialize(double t) override;
  void connect(PortId in) override { ports_.connect(in); }
  double stable_time_step() const override;
  double advance(const TimeWindow& window) override;
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  double energy() const;

  std::shared_ptr<const Body<2>> body_;
  double stiffness_;   ///< [Pa]
  double overburden_;  ///< [Pa]

  std::vector<double> pore_stress_;  ///< input [Pa]
  std::vector<double> dilatation_;   ///< state
  std::vector<double> slope_;        ///< [1/Pa]
  double load_ = 0.0;                ///< state: the overburden so far, none before the start [Pa]
  double work_ = 0.0;                ///< state [J per metre]
  PortTable ports_;
};

/// `solid: {type: compaction}`.
ModuleType compaction_type();

}  // namespace perifrac
