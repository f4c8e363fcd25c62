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
///
/// What the fluid's pressure will be once it has given all that was taken is told by two answers to
/// a mass m over a window of length L. For good it falls by s_V m, s_V the stiffness of all the
/// fluid; and near the mouth by (s - s_V) phi m more, s the stiffness of what lies there, which
/// relaxes in the time tau that sound takes: phi = (1 - exp(-x)) / x, x = L / tau. So the mouth is
/// held at
///   p - s_V (taken - given) + (s - s_V) y,   y <- exp(-x) y + phi (given - taken in the window),
/// taken with what the window takes. Windows of one short step have the fluid answer with s, long
/// ones with s_V and the impedance of sound; where both agree, y and taken - given are 0.
class CrackMouths {
 public:
  explicit CrackMouths(const CrackInlets& inlets);

  bool any() const { return !inlet_.empty(); }
  const PointSet& points() const { return point_set_; }
  // In-ports, by mouth: p [Pa], s and s_V [Pa m/kg], 0 where there is no fluid, tau [s], and what
  // the fluid has given since the start [kg/m].
  std::span<double> pressure() { return pressure_; }
  std::span<double> stiffness() { return stiffness_; }
  std::span<double> volume_stiffness() { return volume_stiffness_; }
  std::span<double> relaxation() { return relaxation_; }
  std::span<double> given() { return given_; }
  /// Taken in since the start [kg/m], by mouth.
  std::span<double> taken_by_mouth() { return taken_by_mouth_; }

  /// Tells the inlets what they are held at over a window of `length` [s].
  void begin_window(double length, CrackInlets& inlets);
  void end_window();
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
  std::vector<double> pressure_, stiffness_, volume_stiffness_, relaxation_, given_;
  std::vector<double> base_, answer_;   ///< over the window: p = base - answer x intake
  std::vector<double> phi_, decay_;     ///< likewise, and exp(-x)
  std::vector<double> intake_;          ///< in the window [kg/m]
  std::vector<double> excess_;          ///< state: y [kg/m]
  std::vector<double> given_before_;    ///< state: at the window's beginning [kg/m]
  std::vector<double> taken_by_mouth_;  ///< state
  CompensatedSum taken_;                ///< state
};

}  // namespace perifrac
