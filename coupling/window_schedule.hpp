#pragma once

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Chooses the windows: from `first` [s] by the factor `growth` to `largest` [s].
class WindowSchedule {
 public:
  WindowSchedule(double first, double growth, double largest);

  /// End [s] of the window that begins at `t` and must not step over `stop`, nor be longer than
  /// `stable` [s]. `stop` is hit exactly, and a rest of less than two windows is halved rather than
  /// leaving a sliver.
  double end(double t, double stop, double stable) const;

  /// The window was run to its end: the next may be longer.
  void grow();
  /// A sudden load: what follows is as fast as at the start.
  void start_over() { length_ = first_; }

  void visit_state(StateVisitor& visitor) { visitor.visit("window_length", length_); }

 private:
  double first_;
  double growth_;
  double largest_;
  double length_;
};

}  // namespace perifrac
