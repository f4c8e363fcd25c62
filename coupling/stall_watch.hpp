#pragma once

namespace perifrac {

/// Tells a run that no longer gets on from one whose windows are short: as many in a row as
/// `patience`, ended early or cut, that together are next to nothing of one as it was to be. A
/// crack that runs through the body in no time ends as many, but none so early.
class StallWatch {
 public:
  static constexpr int patience = 200;
  /// What is shorter than this part of the window as it was to be is not tried.
  static constexpr double shortest = 1e-9;

  /// A window came to `length` that was to be `whole` [s]; true where nothing goes on.
  bool finds_stall(double length, double whole) {
    constexpr double progress = 1e-6;
    went_on_ += length;
    if (went_on_ > progress * whole) went_on_ = windows_ = 0;
    return ++windows_ > patience;
  }
  double went_on() const { return went_on_; }  ///< over these windows [s]

 private:
  int windows_ = 0;
  double went_on_ = 0.0;
};

}  // namespace perifrac
