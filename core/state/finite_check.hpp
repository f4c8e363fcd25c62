#pragma once

#include "core/module/point_set.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Stops the run at the first value that is not a number or infinite.
class FiniteCheck final : public StateVisitor {
 public:
  /// `time` [s] goes into the error. `points` are the points of the module that is visited: a
  /// field that holds a whole number of values a point is then reported with point and position,
  /// any other with the place in its array.
  explicit FiniteCheck(double time, const PointSet* points = nullptr)
      : time_(time), points_(points) {}

 private:
  /// Throws NumericalError.
  void real(const std::string& name, std::vector<double>& values) override;
  void integer(const std::string&, std::vector<std::int64_t>&) override {}

  std::string place(std::size_t index, std::size_t size) const;

  double time_;
  const PointSet* points_;
};

}  // namespace perifrac
