#pragma once

#include <optional>

namespace perifrac {

/// What modules that depend on each other send within a window.
enum class Split {
  drained,       ///< plain values
  fixed_stress,  ///< value and slope, so that the receiver follows the sender's first answer
  undrained,     ///< the same with the other module first, on what the fluid content was
  automatic,     ///< each pair: undrained where it can be, else fixed_stress
};

enum class WindowType {
  schedule,  ///< from the first to the largest
  one_step,  ///< the shortest of the modules' own stable steps
};

enum class AccelerationType { none, aitken, anderson, quasi_newton };

/// The `coupling` section of a scene.
struct CouplingOptions {
  WindowType window = WindowType::schedule;
  double first_window;    ///< [s]
  double window_growth;   ///< factor from one window to the next
  double largest_window;  ///< [s]
  int retries = 0;        ///< how often a window that failed is tried again, half as long
  Split split = Split::automatic;
  /// 1: one pass a window, on extrapolated inputs; nothing: as many as it takes, and one where that
  /// will do.
  std::optional<int> max_iterations = 1;
  double tolerance = 1e-6;  ///< relative change of what is exchanged, per link
  AccelerationType acceleration = AccelerationType::none;
};

}  // namespace perifrac
