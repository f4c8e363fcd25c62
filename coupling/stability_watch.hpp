#pragma once

#include "coupling/link.hpp"

namespace perifrac {

/// Tells from a lagged link's mismatches whether one pass a window is stable: an error that each
/// window multiplies by a factor beyond 1 outgrows, in the end, all that physics does. Windows are
/// looked at in blocks of ten, by the largest mismatch in each. It is called growth if a block
/// exceeds the one before by half, and by more than any motion up to the fourth power of time makes
/// while windows become longer. Unstable is what exceeds the values that were there before and
/// grows over
/// - two blocks in which the prediction is off by more than the value itself in every window, as
///   with errors that change sign; or
/// - ten blocks, from a state that was predicted to a hundredth of its size, or by the same factor
///   from block to block; or
/// - forty.
/// A shock, a resonance, a load that rises do none of these, nor does a wave that comes to where
/// all was at rest: what announces it grows long, but ever slower.
class StabilityWatch {
 public:
  /// A one-pass window of `length` [s] has passed; true where it is unstable.
  bool finds_growth(const Link::Mismatch& mismatch, double length);

 private:
  /// Largest values over a block of windows.
  struct Block {
    int windows = 0;
    double mismatch = 0.0;
    double growing = 0.0;        ///< mismatch over length^4
    bool exceeds_values = true;  ///< in all windows
  };
  void end_block();

  Block block_;
  double last_ = 0.0;           ///< `growing` of the last block
  double largest_value_ = 0.0;  ///< so far
  double values_before_ = 0.0;  ///< the same before the growth began
  bool was_predicted_ = false;  ///< these values
  int growing_ = 0;             ///< blocks
  double last_factor_ = 0.0;    ///< logarithm of the growth from block to block
  int steady_ = 0;              ///< blocks that grew as the one before
  int exceeding_ = 0;           ///< blocks
};

}  // namespace perifrac
