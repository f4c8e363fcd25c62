#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/time/scheduled_vector.hpp"

namespace perifrac {

/// What drives the flow from outside: pressures of faces [Pa] and volumes per time that come in at
/// points [m^3/s, per metre in 2D], by their schedules.
class FlowDrive {
 public:
  /// `sources` of size 0 where there are none.
  FlowDrive(ScheduledVector face_pressures, ScheduledVector sources);

  Eigen::Index faces() const { return face_pressures_.size(); }
  bool has_sources() const { return sources_.size() > 0; }
  bool pressures_change() const { return !face_pressures_.is_constant(); }
  bool sources_change() const { return !sources_.is_constant(); }
  /// Where schedules change their rate, rising [s].
  const std::vector<double>& break_points() const { return break_points_; }
  double largest_pressure() const { return largest_pressure_; }  ///< of all times [Pa]

  void pressures_at(double t, Eigen::VectorXd& pressures) const {
    face_pressures_.at(t, pressures);
  }
  /// Finds source_rate() anew.
  void find_sources(double t) { sources_.at(t, source_rate_); }
  const Eigen::VectorXd& source_rate() const { return source_rate_; }

 private:
  ScheduledVector face_pressures_;
  ScheduledVector sources_;
  std::vector<double> break_points_;
  double largest_pressure_ = 0.0;
  Eigen::VectorXd source_rate_;
};

}  // namespace perifrac
