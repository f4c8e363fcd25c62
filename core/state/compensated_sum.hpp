#pragma once

#include <string>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Adds `value` to `sum` and keeps in `lost` what rounding cuts off, for the next time (Kahan
/// 1965, with Knuth's two-sum): however many terms there are, the sum is right to the last digit.
inline void add_compensated(double& sum, double& lost, double value) {
  value += lost;
  const double before = sum;
  sum += value;
  const double added = sum - before;
  lost = (before - (sum - added)) + (value - added);
}

/// A sum of many terms, to the last digit.
class CompensatedSum {
 public:
  void add(double value) { add_compensated(sum_, lost_, value); }
  double value() const { return sum_ + lost_; }

  void visit_state(StateVisitor& visitor, const std::string& name) {
    visitor.visit(name, sum_);
    visitor.visit(name + "_lost", lost_);
  }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace perifrac
