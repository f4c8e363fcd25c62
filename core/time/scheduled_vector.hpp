#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

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

  /// Adds matrix * other.
  void add(const Eigen::SparseMatrix<double>& matrix, const ScheduledVector& other) {
    constant_ += matrix * other.constant_;
    for (const auto& [schedule, vector] : other.parts_) add(schedule, matrix * vector);
  }

  bool is_constant() const { return parts_.empty(); }

  /// `sum`, of the right size already, at time t [s].
  void at(double t, Eigen::VectorXd& sum) const {
    sum = constant_;
    for (const auto& [schedule, vector] : parts_) sum += schedule.factor(t) * vector;
  }

 private:
  Eigen::VectorXd constant_;
  std::vector<std::pair<Schedule, Eigen::VectorXd>> parts_;
};

}  // namespace perifrac
