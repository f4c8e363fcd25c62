#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/time/schedule.hpp"

namespace perifrac {

/// A sum of vectors, each multiplied by a schedule of its own: what a boundary prescribes on all
/// unknowns at a time.
class ScheduledVector {
 public:
  explicit ScheduledVector(Eigen::Index size) : constant_(Eigen::VectorXd::Zero(size)) {}

  void add(const Schedule& schedule, const Eigen::VectorXd& vector) {
    if (schedule.is_constant()) {
      constant_ += vector;
    } else {
      parts_.emplace_back(schedule, vector);
    }
  }

  Eigen::Index size() const { return constant_.size(); }
  bool is_constant() const { return parts_.empty(); }

  /// Of all its schedules, sorted [s].
  std::vector<double> break_points() const {
    std::vector<double> all;
    for (const auto& [schedule, vector] : parts_) {
      all.insert(all.end(), schedule.break_points().begin(), schedule.break_points().end());
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// `sum`, of the right size already, at time t [s].
  void at(double t, Eigen::VectorXd& sum) const {
    sum = constant_;
    for (const auto& [schedule, vector] : parts_) sum += schedule.factor(t) * vector;
  }

  Eigen::VectorXd at(double t) const {
    Eigen::VectorXd sum(size());
    at(t, sum);
    return sum;
  }

 private:
  Eigen::VectorXd constant_;
  std::vector<std::pair<Schedule, Eigen::VectorXd>> parts_;
};

}  // namespace perifrac
