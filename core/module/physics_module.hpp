#pragma once

#include <span>
#include <string>

#include "core/module/port.hpp"
#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// One physics. It knows no other physics: it meets the rest of the world only at its ports.
/// Use: initialize once; then per window write inputs, advance, read outputs. To repeat a window,
/// visit_state with what was saved before it, and on_restored.
class PhysicsModule {
 public:
  PhysicsModule() = default;
  PhysicsModule(const PhysicsModule&) = delete;  // ports show the module they were made by
  PhysicsModule& operator=(const PhysicsModule&) = delete;
  virtual ~PhysicsModule() = default;

  /// The ports, in an order that never changes.
  virtual std::span<const Port> ports() const = 0;

  /// Values of one port as they stand now; to read them changes nothing. Only the coupling manager
  /// writes inputs; one that is not connected has no values, or zeros. Spans stay valid until the
  /// next advance, visit_state or on_restored.
  virtual PortView port(PortId id) = 0;

  /// Makes the state ready at time t [s], before anything is exchanged.
  virtual void initialize(double t) = 0;

  /// After initialize: some module writes this in-port from now on. Effects of inputs that are not
  /// connected are absent.
  virtual void connect([[maybe_unused]] PortId in) {}

  /// The longest stable step of its own [s], with which it sub-cycles in any window; infinity where
  /// implicit. A scene may ask for windows of one such step.
  virtual double stable_time_step() const = 0;

  /// This window is about to be tried, from where the module stands: what its outputs foretell
  /// (PortView::forecast) is of it.
  virtual void prepare([[maybe_unused]] const TimeWindow& window) {}

  /// Where, by what came before, this window will end early [s], or window.end; that is tried
  /// first.
  virtual double expected_end(const TimeWindow& window) const { return window.end; }

  /// Advances over the window with steps of its own; returns the time reached [s]. Less than
  /// window.end means an event: the manager takes every module back and ends the window there.
  /// Throws NumericalError.
  virtual double advance(const TimeWindow& window) = 0;

  /// After advance: what it does with its inputs is not settled yet, and the window should be
  /// passed through once more, where the scene allows more than one pass.
  virtual bool wants_another_pass() const { return false; }

  /// All modules agree at the window's end. Where something happened within it that changes what
  /// follows, and the module wants the window to end there: returns that time [s], and the manager
  /// takes every module back and redoes the window up to it. Otherwise the window stands: does what
  /// its end brings about (bonds break) and returns window.end.
  virtual double conclude(const TimeWindow& window) { return window.end; }

  /// False: neither advance() nor conclude() ever ends a window early.
  virtual bool may_end_windows() const { return true; }

  /// How its forces or flows go over the bonds of a body, and why; empty: it has none.
  virtual std::string path() const { return {}; }

  /// Shows every evolving field once; a visitor that restores may resize.
  virtual void visit_state(StateVisitor& visitor) = 0;

  /// The state was replaced: drop what was derived from the old one (integrator history, caches).
  /// Restoring the state it already has and calling this must not depend on what came before.
  virtual void on_restored(double t) = 0;
};

}  // namespace perifrac
