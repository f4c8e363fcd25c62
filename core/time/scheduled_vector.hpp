#pragma once

#include <algorithm>
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

  Eigen::Index size() const { return constant_.size(); }
  bool is_constant() const { return parts_.empty(); }

  /// The entry is other than 0 at some time.
  bool has(Eigen::Index entry) const {
    return constant_[entry] != 0.0 ||
           std::ranges::any_of(parts_, [&](const auto& part) { return part.second[entry] != 0.0; });
  }

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
