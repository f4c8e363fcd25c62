#pragma once

namespace perifrac {

/// The interval that the coupling manager asks a module to advance over [s].
/// A window of no length asks for the instant answer to a jump: storage answers, nothing flows.
struct TimeWindow {
  double begin;
  double end;

  double length() const { return end - begin; }
};

}  // namespace perifrac
