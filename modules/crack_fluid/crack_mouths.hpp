#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/state/compensated_sum.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/crack_fluid/crack_inlets.hpp"

namespace perifrac {

/// The inlets at which a crack takes its fluid from free fluid beside the body: held at that
/// fluid's pressure, and shut where there is none. The fluid gives what they took afterwards.
class CrackMouths {
 public:
  explicit CrackMouths(const CrackInlets& inlets);

  bool any() const { return !inlet_.empty(); }
  const PointSet& points() const { return point_set_; }
  // In-ports: the fluid's pressure at each mouth [Pa], had nothing been taken in the window, and by
  // how much what is taken lowers it [Pa m/kg]; 0 where there is no fluid.
  std::span<double> pressure() { return pressure_; }
  std::span<double> stiffness() { return stiffness_; }
  /// Taken in over the last window [kg/m].
  std::span<double> intake() { return intake_; }

  /// Tells the inlets what they are held at.
  void begin_window(CrackInlets& inlets);
  /// Counts the inflow of a facet over a step where a mouth brings it; true: it does.
  bool book(Index facet, double inflow, CrackInlets& inlets);

  double taken() const { return taken_.value(); }  ///< since the start [kg/m]
  void clear();
  void visit_state(StateVisitor& visitor);

 private:
  void supply(std::size_t mouth, CrackInlets& inlets) const;

  std::vector<std::size_t> inlet_;  ///< by mouth: which of the inlets
  std::array<std::vector<double>, 2> place_;
  PointSet point_set_;
  std::vector<double> pressure_, stiffness_;
  std::vector<double> intake_;  ///< state
  CompensatedSum taken_;        ///< state
};

}  // namespace perifrac
