#pragma once

#include <cstdint>

#include "core/state/state_visitor.hpp"
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
/// all was at rest: what announces it grows long, but ever slower. What was found once stays.
class StabilityWatch {
 public:
  /// A one-pass window of `length` [s] has passed.
  void look(const Link::Mismatch& mismatch, double length);

  bool has_found_growth() const { return has_found_growth_ != 0; }

  /// A run that is restarted ends where the whole one does.
  void visit_state(StateVisitor& visitor);

 private:
  using Count = std::int64_t;

  /// Largest values over a block of windows.
  struct Block {
    Count windows = 0;
    double mismatch = 0.0;
    double growing = 0.0;      ///< mismatch over length^4
    Count exceeds_values = 1;  ///< in all windows
  };
  void end_block();

  Block block_;
  double last_ = 0.0;           ///< `growing` of the last block
  double largest_value_ = 0.0;  ///< so far
  double values_before_ = 0.0;  ///< the same before the growth began
  Count was_predicted_ = 0;     ///< whether these values were
  Count growing_ = 0;           ///< blocks
  double last_factor_ = 0.0;    ///< logarithm of the growth from block to block
  Count steady_ = 0;            ///< blocks that grew as the one before
  Count exceeding_ = 0;         ///< blocks
  Count has_found_growth_ = 0;
};

}  // namespace perifrac
