#pragma once

#include "core/state/state_visitor.hpp"
#include "coupling/coupling_options.hpp"

namespace perifrac {

/// Chooses the windows: from `first` [s] by the factor `growth` to `largest` [s]; or one explicit
/// step of the modules each, at most `largest`. A window that failed is cut; those after it come
/// back to the length they would have had, as far as windows are easy.
class WindowSchedule {
 public:
  WindowSchedule(WindowType type, double first, double growth, double largest);

  /// End [s] of the window that begins at `t` and must not step over `stop`. `stop` is hit exactly,
  /// and a rest of less than two windows is halved rather than leaving a sliver.
  double end(double t, double stop) const;

  /// What the next window would be without cuts and without a stop [s].
  double whole() const { return length_; }

  /// The window was run to its end: the next may be longer, after a cut only if this one was
  /// `easy`. `stable` is the shortest of the modules' own stable steps now [s].
  void grow(double stable, bool easy = true);
  /// A window of `length` [s] failed: the next is half as long.
  void cut(double length);
  /// The next window is at most `factor` < 1 times the last, but no less than `least` of what it
  /// would have been without cuts.
  void shorten(double factor, double least);
  /// A sudden load: what follows is as fast as at the start.
  void start_over(double stable);

  void visit_state(StateVisitor& visitor) {
    visitor.visit("window_length", length_);
    visitor.visit("window_share", share_);
  }

 private:
  WindowType type_;
  double first_;
  double growth_;
  double largest_;
  double length_;       ///< without cuts
  double share_ = 1.0;  ///< of it, that is left by cuts
};

}  // namespace perifrac
