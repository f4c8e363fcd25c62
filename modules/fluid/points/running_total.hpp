#pragma once

#include <cmath>
#include <string>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// A sum of very many small terms, compensated (Neumaier): its error does not grow with their
/// number.
class RunningTotal {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    rest_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }

  double value() const { return sum_ + rest_; }

  void visit_state(StateVisitor& visitor, const std::string& name) {
    visitor.visit(name, sum_);
    visitor.visit(name + "_rest", rest_);
  }

 private:
  double sum_ = 0.0;
  double rest_ = 0.0;
};

}  // namespace perifrac
