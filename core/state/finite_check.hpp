#pragma once

#include <functional>
#include <string_view>

#include "core/base/point_set.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Stops the run at the first value that is not a number or infinite.
class FiniteCheck final : public StateVisitor {
 public:
  /// The points of a module that is visited, by a name within its fields; null: none are known.
  /// Asked for only where there is something to report.
  using PointsOf = std::function<const PointSet*(std::string_view field)>;

  /// `time` [s] goes into the error. A field that holds a whole number of values a point is
  /// reported with point and position, any other with the place in its array.
  explicit FiniteCheck(double time, PointsOf points_of = {})
      : time_(time), points_of_(std::move(points_of)) {}

 private:
  /// Throws NumericalError.
  void real(const std::string& name, std::vector<double>& values) override;
  void integer(const std::string&, std::vector<std::int64_t>&) override {}

  std::string place(const std::string& name, std::size_t index, std::size_t size) const;

  double time_;
  PointsOf points_of_;
};

}  // namespace perifrac
