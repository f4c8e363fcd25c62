#pragma once

namespace perifrac {

/// What modules that depend on each other send within a window.
enum class Split {
  drained,       ///< plain values
  fixed_stress,  ///< value and slope, so that the receiver follows the sender's first answer
};

enum class AccelerationType { none, aitken, anderson };

/// The `coupling` section of a scene.
struct CouplingOptions {
  double first_window;    ///< [s]
  double window_growth;   ///< factor from one window to the next
  double largest_window;  ///< [s]
  Split split = Split::fixed_stress;
  int max_iterations = 1;   ///< 1: one pass a window, on extrapolated inputs
  double tolerance = 1e-6;  ///< relative change of what is exchanged, per link
  AccelerationType acceleration = AccelerationType::none;
};

}  // namespace perifrac
